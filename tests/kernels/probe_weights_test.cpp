#include <gtest/gtest.h>

#include "cpu/wide.h"
#include "kernels/probe_blend.h"
#include "kernels/probe_query.h"
#include "kernels/random.h"

namespace probegi::kernels {
namespace {

TEST(ProbeQuery, selfShadowBiasIsEquationTwo) {
    const vec3 b = selfShadowBias(vec3(0, 1, 0), vec3(1, 0, 0), 2.0f, 0.3f);
    EXPECT_NEAR(b.x, 0.8f * 0.75f * 2.0f * 0.3f, 1e-6f);
    EXPECT_NEAR(b.y, 0.2f * 0.75f * 2.0f * 0.3f, 1e-6f);
    EXPECT_EQ(b.z, 0.0f);
}

TEST(ProbeQuery, trilinearFactorsOfAnAxisSumToOneInside) {
    for (float a : {0.01f, 0.3f, 0.5f, 0.99f}) EXPECT_NEAR(trilinearFactor(0, a) + trilinearFactor(1, a), 1.0f, 1e-6f);
    EXPECT_EQ(trilinearFactor(1, 0.0f), kMinTrilinear);
}

TEST(ProbeQuery, backfaceWeightFallsFromFrontToBack) {
    EXPECT_FLOAT_EQ(backfaceWeight(1.0f), 1.05f);
    EXPECT_FLOAT_EQ(backfaceWeight(-1.0f), 0.05f);
    EXPECT_FLOAT_EQ(backfaceWeight(0.0f), 0.30f);
}

TEST(ProbeQuery, probesInWallsAreNotUsed) {
    EXPECT_FLOAT_EQ(outsideWeight(0.0f), 1.0f);
    EXPECT_FLOAT_EQ(outsideWeight(kInsideShare), 1.0f);
    EXPECT_FLOAT_EQ(outsideWeight(kInsideShare + 0.5f * kInsideShareEdge), 0.5f);
    EXPECT_FLOAT_EQ(outsideWeight(1.0f), 0.0f);
}

TEST(ProbeQuery, chebyshevIsOneInFrontAndFollowsItsBoundBehind) {
    const float mean = 0.4f, variance = 0.01f, square = mean * mean + variance;
    EXPECT_FLOAT_EQ(chebyshevWeight(mean, square, 0.3f), 1.0f);
    EXPECT_FLOAT_EQ(chebyshevWeight(mean, square, 0.4f), 1.0f);
    const float bound = variance / (variance + 0.1f * 0.1f);
    EXPECT_NEAR(chebyshevWeight(mean, square, 0.5f), bound * bound * bound, 1e-5f);
    EXPECT_FLOAT_EQ(chebyshevWeight(mean, square, 100.0f), kMinChebyshev);
    // Without variance: a sharp step, and no division of zero by zero.
    EXPECT_FLOAT_EQ(chebyshevWeight(0.5f, 0.25f, 0.5f), 1.0f);
    EXPECT_FLOAT_EQ(chebyshevWeight(0.5f, 0.25f, 0.51f), kMinChebyshev);
}

TEST(ProbeQuery, crushIsContinuousMonotoneAndKillsTheFloor) {
    EXPECT_FLOAT_EQ(crushWeight(0.5f), 0.5f);
    EXPECT_NEAR(crushWeight(kCrushBelow * 0.99999f), kCrushBelow, 1e-4f);
    EXPECT_LT(8 * crushWeight(kMinChebyshev * 1.05f), 0.05f);
    for (float w = 0.01f; w < 0.4f; w += 0.01f) EXPECT_LT(crushWeight(w), crushWeight(w + 0.01f));
}

TEST(ProbeBlend, backfacesShortenByEightyPercent) {
    EXPECT_FLOAT_EQ(visibilityDistance(-1.0f, 2.0f), 0.1f);
    EXPECT_FLOAT_EQ(visibilityDistance(1.0f, 2.0f), 0.5f);
    EXPECT_FLOAT_EQ(visibilityDistance(1e30f, 2.0f), 1.0f);
}

TEST(ProbeBlend, thresholdsOfListingThree) {
    const BlendRule rule{0.97f, 0.25f, 0.8f};
    EXPECT_FLOAT_EQ(texelHysteresis(vec3(1.0f), vec3(0.9f), rule), 0.97f);
    EXPECT_FLOAT_EQ(texelHysteresis(vec3(1.0f), vec3(0.7f), rule), 0.97f - 0.15f);
    EXPECT_FLOAT_EQ(texelHysteresis(vec3(1.0f), vec3(0.1f), rule), 0.0f);
    // One channel is enough, and the scale of the light does not matter.
    EXPECT_FLOAT_EQ(texelHysteresis(vec3(8.0f), vec3(8, 8, 5.6f), rule), 0.97f - 0.15f);
    // Black stays black without a division by zero.
    EXPECT_FLOAT_EQ(texelHysteresis(vec3(0.0f), vec3(0.0f), rule), 0.97f);
    EXPECT_FLOAT_EQ(texelHysteresis(vec3(1.0f), vec3(0.1f), BlendRule{0.97f, 0, 0}), 0.97f);
}

TEST(ProbeBlend, encodedBlendFollowsListingOne) {
    const BlendRule rule{0.9f, 0, 0};
    const vec3 v = blendEncoded(vec3(encodeIrradiance(2.0f)), vec3(1.0f), rule);
    EXPECT_NEAR(v.x, 0.9f * std::pow(2.0f, 0.2f) + 0.1f, 1e-6f);
    const vec3 linear = blendLinear(vec3(encodeIrradiance(2.0f)), vec3(1.0f), 0.9f);
    EXPECT_NEAR(decodeIrradiance(linear.x), 1.9f, 1e-5f);
}

// The eight-lane reading of the kernels is the same text; this shows that it is also the same numbers.
TEST(Wide, lanesEqualTheScalarKernels) {
    uint state = 5;
    const auto random = [&](int) { return 2 * nextRandom(state) - 1; };
    for (int round = 0; round < 1000; ++round) {
        std::array<float, 8> x, y, z;
        for (int i = 0; i < 8; ++i) x[i] = random(i), y[i] = random(i), z[i] = random(i);
        const auto load = [](const auto& a) { return wide::Real(a.data(), wide::stdx::element_aligned); };
        const wide::Real2 oct = wide::octEncode({load(x), load(y), load(z)});
        const wide::Real chebyshev = wide::chebyshevWeight(load(x), load(y), load(z));
        const wide::Real crush = wide::crushWeight(load(x));
        for (int i = 0; i < 8; ++i) {
            const vec2 expected = octEncode(vec3(x[i], y[i], z[i]));
            EXPECT_NEAR(oct.x[i], expected.x, 1e-6f);
            EXPECT_NEAR(oct.y[i], expected.y, 1e-6f);
            EXPECT_NEAR(chebyshev[i], chebyshevWeight(x[i], y[i], z[i]), 1e-5f);
            EXPECT_NEAR(crush[i], crushWeight(x[i]), 1e-4f);
        }
    }
}

}  // namespace
}  // namespace probegi::kernels
