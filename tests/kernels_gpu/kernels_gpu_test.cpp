#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>
#include <set>

#include "kernels_gpu/case.h"
#include "kernels_gpu/vulkan_runner.h"
#include "support/source_folder.h"

namespace probegi::test {
namespace {

constexpr std::size_t kLanes = 8192;
constexpr std::size_t kInputsPerLane = 64;
constexpr std::size_t kOutputsPerLane = 128;
constexpr std::size_t kLanesPerGroup = 64;
constexpr std::uint32_t kUntouched = 0xdeadbeefu;

/// Random bits; one value in eight is an end or the middle of the range, where formulas have corner cases.
std::vector<std::uint32_t> randomInputs() {
    constexpr std::uint32_t kCorners[] = {0u, 0x80000000u, 0xffffffffu};
    std::mt19937 generator(20191u);
    std::vector<std::uint32_t> inputs(kLanes * kInputsPerLane);
    for (std::uint32_t& input : inputs) {
        const auto choice = std::uint32_t(generator());
        input = choice % 8 == 0 ? kCorners[choice / 8 % 3] : std::uint32_t(generator());
    }
    return inputs;
}

std::vector<std::uint32_t> readSpirv(const char* path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::copy_n(bytes.data(), words.size() * 4, reinterpret_cast<char*>(words.data()));
    return words;
}

bool agrees(const kernels::Expected& expected, std::uint32_t gotBits) {
    if (expected.exact) return expected.bits == gotBits;
    const float want = kernels::uintBitsToFloat(expected.bits);
    const float got = kernels::uintBitsToFloat(gotBits);
    if (std::isnan(want) || std::isnan(got)) return std::isnan(want) && std::isnan(got);
    if (std::isinf(want) || std::isinf(got)) return want == got;
    return std::abs(got - want) <= expected.tolerance * std::max(1.0f, std::abs(want));
}

/// One for all tests, and never closed: the leak checker can tell a driver's allocations from ours only while the
/// driver is loaded.
const Result<VulkanRunner>& theRunner() {
    static const auto& runner = *new Result<VulkanRunner>(VulkanRunner::create());
    return runner;
}

class EveryKernel : public testing::TestWithParam<KernelCase> {};

TEST_P(EveryKernel, saysTheSameInGlslAndCpp) {
    const auto& runner = theRunner();
    ASSERT_TRUE(runner) << runner.error().message;
    const std::vector<std::uint32_t> inputs = randomInputs();
    std::vector<std::uint32_t> outputs(kLanes * kOutputsPerLane, kUntouched);
    const std::uint32_t sizes[] = {kInputsPerLane, kOutputsPerLane, kLanes};
    const auto done =
        runner->run(readSpirv(GetParam().spirvPath), inputs, outputs, sizes, int(kLanes / kLanesPerGroup));
    ASSERT_TRUE(done) << done.error().message;

    int differences = 0;
    for (std::size_t index = 0; index < kLanes && differences < 10; ++index) {
        kernels::Lane lane{.inputs = std::span(inputs).subspan(index * kInputsPerLane, kInputsPerLane)};
        GetParam().evaluate(lane);
        ASSERT_FALSE(lane.ranOut) << "the shader takes more than " << kInputsPerLane << " inputs";
        ASSERT_FALSE(lane.outputs.empty()) << "the shader gives nothing";
        ASSERT_LT(lane.outputs.size(), kOutputsPerLane) << "the shader gives too many values";
        const auto got = std::span(outputs).subspan(index * kOutputsPerLane, kOutputsPerLane);
        for (std::size_t k = 0; k < lane.outputs.size(); ++k) {
            if (agrees(lane.outputs[k], got[k])) continue;
            ++differences;
            ADD_FAILURE() << "lane " << index << ", result " << k << ": C++ says "
                          << kernels::uintBitsToFloat(lane.outputs[k].bits) << " (bits " << lane.outputs[k].bits
                          << "), " << runner->deviceName() << " says " << kernels::uintBitsToFloat(got[k]) << " (bits "
                          << got[k] << ")";
        }
        EXPECT_EQ(got[lane.outputs.size()], kUntouched) << "the GPU gave more values than C++ in lane " << index;
    }
}

INSTANTIATE_TEST_SUITE_P(, EveryKernel, testing::ValuesIn(kernelCases().begin(), kernelCases().end()),
                         [](const auto& kernel) { return std::string(kernel.param.name); });

/// Of src/kernels and its folders.
std::vector<std::filesystem::path> kernelHeaders() {
    std::vector<std::filesystem::path> headers;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder() / "src/kernels"))
        if (entry.path().extension() == ".h") headers.push_back(entry.path());
    return headers;
}

TEST(KernelHeaders, eachHasAShader) {
    std::set<std::string> tested;
    for (const KernelCase& kernelCase : kernelCases()) tested.insert(kernelCase.name);
    EXPECT_GT(kernelHeaders().size(), 40u);
    for (const std::filesystem::path& header : kernelHeaders())
        EXPECT_THAT(tested, testing::Contains(header.stem().string()))
            << header << " needs a tests/kernels_gpu/shaders/" << header.stem().string() << ".comp";
}

std::string readText(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(KernelHeaders, eachFunctionIsCalledByItsShader) {
    const std::regex function("(?:KERNEL|LOOKUP|HIT)_FN [\\w()]+ (\\w+)\\(");
    int functions = 0;
    for (const std::filesystem::path& path : kernelHeaders()) {
        const std::string name = path.stem().string(), header = readText(path);
        const std::string shader = readText(sourceFolder() / "tests/kernels_gpu/shaders" / (name + ".comp"));
        for (std::sregex_iterator it(header.begin(), header.end(), function), end; it != end; ++it, ++functions) {
            EXPECT_THAT(shader, testing::HasSubstr((*it)[1].str() + "(")) << name << ".comp leaves it untested";
        }
    }
    EXPECT_GT(functions, 200);
}

TEST(Comparison, seesWhatDiffers) {
    const auto bits = [](float x) { return kernels::floatBitsToUint(x); };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(agrees({.bits = bits(100.0f), .tolerance = 1e-3f}, bits(100.09f)));
    EXPECT_FALSE(agrees({.bits = bits(100.0f), .tolerance = 1e-3f}, bits(100.11f)));
    EXPECT_FALSE(agrees({.bits = bits(1.0f), .tolerance = 1.0f}, bits(nan)));
    EXPECT_FALSE(agrees({.bits = bits(nan), .tolerance = 1.0f}, bits(1.0f)));
    EXPECT_TRUE(agrees({.bits = bits(nan), .tolerance = 0.0f}, bits(-nan)));
    EXPECT_FALSE(agrees({.bits = 7u, .exact = true}, 8u));
}

}  // namespace
}  // namespace probegi::test
