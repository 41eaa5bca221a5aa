#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "io/image_codec.h"
#include "io/refused.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImageFile : public testing::Test {
protected:
    ImageFile() : m_folder(fs::temp_directory_path() / ("probegi_image_" + std::to_string(getpid()))) {
        fs::create_directories(m_folder);
    }
    ~ImageFile() override { fs::remove_all(m_folder); }

    fs::path path(const char* name) const { return m_folder / name; }
    std::vector<char> bytes(const char* name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void write(const char* name, const std::vector<char>& content) const {
        std::ofstream(path(name), std::ios::binary).write(content.data(), std::streamsize(content.size()));
    }
    std::size_t fileCount() const {
        return std::size_t(std::distance(fs::directory_iterator(m_folder), fs::directory_iterator()));
    }

    fs::path m_folder;
};

HdrImage gradient(int width, int height) {
    HdrImage image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.at(x, y) = {float(x) / float(width), float(y) / float(height), float(x ^ y) / 64.0f};
        }
    }
    return image;
}

TEST_F(ImageFile, ExrKeepsEveryBit) {
    HdrImage image = gradient(37, 23);
    image.at(0, 0) = {1e-30f, 1e30f, -5.0f};
    image.at(1, 0) = {std::numeric_limits<float>::infinity(), 0.1f, 1.0f / 3.0f};
    ASSERT_TRUE(writeImage(path("a.exr"), image));
    const auto back = readImage(path("a.exr"));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->width, 37);
    EXPECT_EQ(back->height, 23);
    EXPECT_EQ(back->pixels, image.pixels);
    EXPECT_EQ(fileCount(), 1u) << "no temporary file is left";
}

TEST_F(ImageFile, PngComesBackWithinHalfAStep) {
    const HdrImage image = gradient(61, 17);
    ASSERT_TRUE(writeImage(path("a.PNG"), image, {.dither = false}));
    const auto back = readImage(path("a.PNG"));
    ASSERT_TRUE(back) << back.error().message;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3 wanted = toDisplay(image.pixels[i], {});
        const glm::vec3 got = toDisplay(back->pixels[i], {});
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(got[c], wanted[c], 0.5f / 255 + 1e-4f) << i;
    }
}

/// The codes of a PNG of 16 x 16 pixels of one brightness, in steps of 8 bits.
std::vector<float> stepsOf(const fs::path& file, float display) {
    const float linear = display <= 0.04045f ? display / 12.92f : std::pow((display + 0.055f) / 1.055f, 2.4f);
    EXPECT_TRUE(writeImage(file, HdrImage(16, 16, glm::vec3(linear))));
    std::vector<float> steps;
    for (const glm::vec3& pixel : readImage(file).value_or(HdrImage()).pixels)
        steps.push_back(255.0f * toDisplay(pixel, {}).x);
    return steps;
}

TEST_F(ImageFile, PngIsDithered) {
    for (const float steps : {20.25f, 100.5f, 200.9f}) {
        float sum = 0;
        for (const float step : stepsOf(path("a.png"), steps / 255)) {
            EXPECT_LT(std::abs(step - steps), 1.01f);
            sum += step;
        }
        EXPECT_NEAR(sum / 256, steps, 0.02f) << "the mean of a block is what the steps cannot hold";
    }
}

TEST_F(ImageFile, DitherLeavesWhatEightBitsHold) {
    for (const float step : {0.0f, 1.0f, 77.0f, 254.0f, 255.0f})
        for (const float got : stepsOf(path("a.png"), step / 255)) ASSERT_NEAR(got, step, 1e-3f);
}

TEST_F(ImageFile, OverwritesWhole) {
    ASSERT_TRUE(writeImage(path("a.exr"), gradient(64, 64)));
    ASSERT_TRUE(writeImage(path("a.exr"), gradient(3, 3)));
    EXPECT_EQ(readImage(path("a.exr"))->width, 3);
}

TEST_F(ImageFile, ReadsRadianceHdr) {
    // One row of two pixels, uncompressed RGBE: (1, 0.5, 0.25) and black.
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    std::vector<char> file(header.begin(), header.end());
    for (const int b : {128, 64, 32, 129, 0, 0, 0, 0}) file.push_back(char(b));
    write("a.hdr", file);
    const auto image = readImage(path("a.hdr"));
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->pixels.size(), 2u);
    EXPECT_EQ(image->pixels[0], glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(image->pixels[1], glm::vec3(0.0f));
}

TEST_F(ImageFile, TruncatedHdrEnds) {
    // Two rows of eight pixels, run-length encoded: each channel is one run of eight.
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n";
    std::vector<char> file(header.begin(), header.end());
    for (int row = 0; row < 2; ++row) {
        for (const int b : {2, 2, 0, 8, 136, 128, 136, 64, 136, 32, 136, 129}) file.push_back(char(b));
    }
    write("a.hdr", file);
    const auto whole = readImage(path("a.hdr"));
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_EQ(whole->pixels.back(), glm::vec3(1.0f, 0.5f, 0.25f));
    for (std::size_t length = 0; length < file.size(); ++length) {
        write("a.hdr", {file.begin(), file.begin() + std::ptrdiff_t(length)});
        EXPECT_FALSE(readImage(path("a.hdr"))) << length;
    }
    file[header.size() + 4] = 0;  // a run of nothing
    write("a.hdr", file);
    EXPECT_FALSE(readImage(path("a.hdr")));
}

TEST_F(ImageFile, ErrorsSayWhatIsWrong) {
    const auto expect = [&](const Result<HdrImage>& result, ErrorCode code, const char* words) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, code) << result.error().message;
        EXPECT_THAT(result.error().message, HasSubstr(words));
    };
    expect(readImage(path("none.exr")), ErrorCode::fileNotFound, "none.exr");
    expect(readImage(path("a.tga")), ErrorCode::unsupported, ".tga");
    expect(readImage(m_folder / "x.png" / "y.png"), ErrorCode::fileNotFound, "y.png");
    fs::create_directory(path("folder.png"));
    expect(readImage(path("folder.png")), ErrorCode::fileUnreadable, "not a file");
    for (const char* name : {"empty.exr", "empty.png", "empty.jpg", "empty.hdr"}) {
        write(name, {});
        expect(readImage(path(name)), ErrorCode::malformed, name);
    }
    ASSERT_TRUE(writeImage(path("a.exr"), gradient(4, 4)));
    fs::rename(path("a.exr"), path("a.png"));
    expect(readImage(path("a.png")), ErrorCode::malformed, "not a PNG");
}

TEST_F(ImageFile, DamageNeverCrashes) {
    for (const char* name : {"a.exr", "a.png"}) {
        ASSERT_TRUE(writeImage(path(name), gradient(40, 40)));
        const std::vector<char> file = bytes(name);
        const std::vector<std::uint8_t> whole(file.begin(), file.end());
        const auto format = name[2] == 'e' ? io::ImageFormat::exr : io::ImageFormat::png;
        const auto decode = [&](std::span<const std::uint8_t> content) {
            return io::guarded(name, [&] { return io::decodeImage(content, format); });
        };
        ASSERT_TRUE(decode(whole));
        constexpr std::size_t kChecksum = 4;  // of PNG's empty last chunk: without it, the pixels are complete
        for (std::size_t length = 0; length + kChecksum < whole.size(); ++length) {
            EXPECT_FALSE(decode(std::span(whole).first(length))) << name << " of " << length << " bytes";
        }
        for (std::size_t at = 0; at < whole.size(); ++at) {
            for (const int flip : {0x01, 0x40, 0xff}) {
                std::vector<std::uint8_t> flipped = whole;
                flipped[at] = std::uint8_t(flipped[at] ^ flip);
                (void)decode(flipped);
            }
        }
    }
}

TEST_F(ImageFile, RefusesInvalidPictures) {
    const auto expect = [&](const char* name, const HdrImage& image, const ToneMap& map, ErrorCode code) {
        const auto result = writeImage(path(name), image, map);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, code) << result.error().message;
        EXPECT_THAT(result.error().message, HasSubstr(name));
        EXPECT_EQ(fileCount(), 0u);
    };
    expect("a.exr", HdrImage(), {}, ErrorCode::invalidArgument);
    HdrImage lying(4, 4);
    lying.pixels.pop_back();
    expect("a.png", lying, {}, ErrorCode::invalidArgument);
    expect("a.bmp", gradient(2, 2), {}, ErrorCode::unsupported);
    expect("a.png", gradient(2, 2), {.exposure = 0.0f}, ErrorCode::invalidArgument);
}

TEST_F(ImageFile, NotANumberBecomesBlackInPng) {
    HdrImage image(2, 1, glm::vec3(1.0f));
    image.pixels[0] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    ASSERT_TRUE(writeImage(path("a.png"), image));
    EXPECT_EQ(readImage(path("a.png"))->pixels[0], glm::vec3(0.0f));
}

TEST_F(ImageFile, FailedWritesLeaveNothing) {
    const auto gone = writeImage(m_folder / "missing" / "a.exr", gradient(4, 4));
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().code, ErrorCode::writeFailed);
    EXPECT_THAT(gone.error().message, HasSubstr("does not exist"));
    fs::create_directory(path("folder.exr"));
    const auto folder = writeImage(path("folder.exr"), gradient(4, 4));
    ASSERT_FALSE(folder);
    EXPECT_EQ(folder.error().code, ErrorCode::writeFailed);
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(ImageFile, FullDiskKeepsTheOldFile) {
    ASSERT_TRUE(writeImage(path("a.exr"), gradient(4, 4)));
    const std::vector<char> before = bytes("a.exr");
    // A limit on file sizes makes a write fail half way, as on a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    const rlimit small{1000, old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto result = writeImage(path("a.exr"), gradient(200, 200));
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::writeFailed);
    EXPECT_THAT(result.error().message, HasSubstr("a.exr"));
    EXPECT_EQ(bytes("a.exr"), before);
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(ImageFile, ReadOnlyFolder) {
    if (geteuid() == 0) {
        // Root may write anywhere, except to a folder below a file.
        write("file", {'x'});
        EXPECT_EQ(writeImage(path("file") / "a.exr", gradient(2, 2)).error().code, ErrorCode::writeFailed);
        return;
    }
    fs::permissions(m_folder, fs::perms::owner_read | fs::perms::owner_exec);
    const auto result = writeImage(path("a.exr"), gradient(2, 2));
    fs::permissions(m_folder, fs::perms::owner_all);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::writeFailed);
}

}  // namespace
}  // namespace probegi::test
