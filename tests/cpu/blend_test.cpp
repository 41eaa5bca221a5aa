#include "cpu/blend_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cpu/field_view.h"
#include "field/control_impl.h"
#include "field/layout.h"
#include "kernels/blend/probe_blend.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/storage.h"
#include "kernels/trace/ray_set.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct BlendInput {
    explicit BlendInput(BackfaceRule rule = BackfaceRule::zeroSample) : desc(), layout(desc), storage(layout) {
        desc.volumes = {{{0, 0, 0}, {1, 1.5f, 2}, {5, 3, 4}}};
        desc.raysPerProbe = 100;
        desc.backfaceRule = rule;
        layout = FieldLayout(desc);
        storage = FieldStorage(layout);
        for (std::uint32_t i = 0; i < 100; ++i)
            directions.push_back(kernels::frameRotation(1, 0) * kernels::sphericalFibonacci(i, 100));
        std::uint32_t state = 9;
        for (std::size_t i = 0; i < layout.probes * layout.rays; ++i) {
            RayDatum d{glm::vec3(0), 3.0f * kernels::nextRandom(state)};
            for (int c = 0; c < 3; ++c) d.radiance[c] = std::exp(4 * kernels::nextRandom(state) - 2);
            if (i % 7 == 0) d.distance = -d.distance;
            data.push_back(d);
        }
    }

    void blend(int threads = 2, BlendFrame frame = {{}, {0, 0}, false, 5}) {
        const FieldControl control = makeFieldControl(desc, desc);
        frame.tasks = control.tasks();
        const Context context = *Context::create({.threads = threads});
        BlendWeights weights;
        makeBlendWeights(context, desc, desc.visibilityExponent, directions, weights);
        blendProbes(context, desc, makeVolumes(desc), desc, weights, data, frame, storage);
    }

    float stored(std::size_t probe, std::size_t texel, int channel) const {
        return kernels::unpackHalf(storage.irradiance[3 * (probe * layout.irradianceTexels + texel) + channel]);
    }

    FieldSetup desc;
    FieldLayout layout;
    FieldStorage storage;
    std::vector<glm::vec3> directions;
    std::vector<RayDatum> data;
};

// Eq. 1 as in the paper, one texel at a time: the oracle for the matrix product.
glm::dvec3 directMean(const BlendInput& s, std::size_t probe, int texel) {
    const glm::vec3 n = kernels::octTexelDirection(texel % 8, texel / 8, 8);
    glm::dvec3 sum(0.0);
    double weights = 0;
    for (std::size_t ray = 0; ray < s.layout.rays; ++ray) {
        const RayDatum& d = s.data[probe * s.layout.rays + ray];
        const bool backface = d.distance < 0;
        if (backface && s.desc.backfaceRule == BackfaceRule::excluded) continue;
        const double w = std::max(0.0, double(glm::dot(n, s.directions[ray])));
        if (!backface) sum += w * glm::dvec3(d.radiance);
        weights += w;
    }
    return sum / weights;
}

glm::dvec2 directMoments(const BlendInput& s, std::size_t probe, int texel) {
    const glm::vec3 n = kernels::octTexelDirection(texel % 16, texel / 16, 16);
    glm::dvec2 sum(0.0);
    double weights = 0;
    for (std::size_t ray = 0; ray < s.layout.rays; ++ray) {
        const double w = std::pow(std::max(0.0, double(glm::dot(n, s.directions[ray]))), s.desc.visibilityExponent);
        const float t = s.data[probe * s.layout.rays + ray].distance;
        const double d = std::min(t < 0 ? -0.2 * t : double(t), double(visibilityRange(s.desc.volumes[0]))) /
                         visibilityRange(s.desc.volumes[0]);
        sum += w * glm::dvec2(d, d * d);
        weights += w;
    }
    return sum / weights;
}

class BlendRules : public testing::TestWithParam<BackfaceRule> {};

TEST_P(BlendRules, matrixProductEqualsTheDirectSum) {
    BlendInput s(GetParam());
    s.blend();
    for (std::size_t probe = 0; probe < s.layout.probes; ++probe) {
        for (int texel = 0; texel < 64; ++texel) {
            const glm::dvec3 mean = directMean(s, probe, texel);
            for (int c = 0; c < 3; ++c) {
                const double stored = s.stored(probe, texel, c);
                // One step of a half float: 2^-10.
                EXPECT_NEAR(stored / std::pow(mean[c], 0.2), 1.0, 1.0 / 1024 + 1e-5);
            }
        }
        for (int texel = 0; texel < 256; ++texel) {
            const glm::dvec2 moments = directMoments(s, probe, texel);
            const std::uint32_t packed = s.storage.visibility[probe * 256 + texel];
            EXPECT_NEAR(kernels::unpackUnorm16(packed & 0xffff), moments.x, 1.0 / 65535 + 2e-6);
            EXPECT_NEAR(kernels::unpackUnorm16(packed >> 16), moments.y, 1.0 / 65535 + 2e-6);
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Blend, BlendRules, testing::Values(BackfaceRule::zeroSample, BackfaceRule::excluded));

// Powers of small cosines can be denormal numbers, which some processors multiply a hundred times more slowly.
TEST(BlendWeights, AreNormalNumbersOrZero) {
    BlendInput s;
    s.desc.visibilityExponent = 100;
    BlendWeights weights;
    makeBlendWeights(*Context::create({.threads = 1}), s.desc, s.desc.visibilityExponent, s.directions, weights);
    std::size_t zeros = 0;
    for (const std::vector<float>* all : {&weights.irradiance, &weights.visibility})
        for (const float w : *all) {
            EXPECT_TRUE(w == 0 || w > 1e-12f) << w;
            zeros += w == 0 ? 1 : 0;
        }
    EXPECT_GT(zeros, weights.visibility.size() / 2);
}

TEST(Blend, isTheSameForAnyNumberOfThreads) {
    BlendInput one, three;
    one.blend(1);
    three.blend(3);
    EXPECT_EQ(one.storage.irradiance, three.storage.irradiance);
    EXPECT_EQ(one.storage.visibility, three.storage.visibility);
}

TEST(Blend, badRadianceAndDistanceNeverEnterTheAtlas) {
    BlendInput good, bad;
    for (std::size_t i = 0; i < good.data.size(); i += 11) {
        good.data[i] = {glm::vec3(0), 100.0f};
        const float poison[] = {kNan, kInfinity, -kInfinity, -1.0f};
        const float far[] = {kNan, -kNan, kInfinity};
        bad.data[i] = {glm::vec3(poison[i % 4]), far[i / 11 % 3]};
    }
    good.blend();
    bad.blend();
    EXPECT_EQ(good.storage.irradiance, bad.storage.irradiance);
    EXPECT_EQ(good.storage.visibility, bad.storage.visibility);
}

}  // namespace
}  // namespace probegi
