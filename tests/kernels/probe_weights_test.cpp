#include <gtest/gtest.h>

#include <array>
#include <set>

#include "kernels/blend/probe_blend.h"
#include "kernels/guards/moments.h"
#include "kernels/lookup/probe_neighbours.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/lookup/surface_gradient.h"
#include "kernels/random.h"
#include "kernels/volume/probe_cage.h"

namespace probegi::kernels {
namespace {

TEST(ProbeQuery, selfShadowBiasIsEquationTwo) {
    const vec3 b = selfShadowBias(vec3(0, 1, 0), vec3(1, 0, 0), 2.0f, 0.3f);
    EXPECT_NEAR(b.x, 0.8f * 0.75f * 2.0f * 0.3f, 1e-6f);
    EXPECT_NEAR(b.y, 0.2f * 0.75f * 2.0f * 0.3f, 1e-6f);
    EXPECT_EQ(b.z, 0.0f);
}

// The paper's rules test visibility where eq. 2 says and do not move the cage; the measured ones do both along the
// normal and the view, in proportion to the spacing and to the tunable bias.
TEST(ProbeQuery, biasesOfTheTwoRules) {
    const vec3 n(0, 1, 0), v(1, 0, 0);
    EXPECT_EQ(visibilityBias(n, v, 2.0f, 0.3f, kRulesPaper), selfShadowBias(n, v, 2.0f, 0.3f));
    EXPECT_EQ(cageBias(n, v, 2.0f, 0.3f, kRulesPaper), vec3(0.0f));
    const vec3 b = visibilityBias(n, v, 2.0f, 0.3f, kRulesMeasured);
    EXPECT_NEAR(b.x, 0.67f * 0.75f * 2.0f * 0.3f, 1e-6f);
    EXPECT_NEAR(b.y, 1.3f * 0.75f * 2.0f * 0.3f, 1e-6f);
    EXPECT_EQ(visibilityBias(n, v, 4.0f, 0.15f, kRulesMeasured), b);
    EXPECT_EQ(cageBias(n, v, 2.0f, 0.3f, kRulesMeasured), 0.25f * selfShadowBias(n, v, 2.0f, 0.3f));
}

TEST(ProbeQuery, trilinearFactorsOfAnAxisSumToOneInside) {
    for (float a : {0.01f, 0.3f, 0.5f, 0.99f}) EXPECT_NEAR(trilinearFactor(0, a) + trilinearFactor(1, a), 1.0f, 1e-6f);
    EXPECT_EQ(trilinearFactor(1, 0.0f), kMinTrilinear);
}

TEST(ProbeQuery, backfaceWeightFallsFromFrontToBack) {
    EXPECT_FLOAT_EQ(backfaceWeight(1.0f, kRulesMeasured), 1.05f);
    EXPECT_FLOAT_EQ(backfaceWeight(-1.0f, kRulesMeasured), 0.05f);
    EXPECT_FLOAT_EQ(backfaceWeight(0.0f, kRulesMeasured), 0.30f);
    EXPECT_FLOAT_EQ(backfaceWeight(1.0f, kRulesPaper), 1.20f);
    EXPECT_FLOAT_EQ(backfaceWeight(-1.0f, kRulesPaper), 0.20f);
}

TEST(ProbeQuery, probesInWallsAreNotUsed) {
    EXPECT_FLOAT_EQ(outsideWeight(0.0f, kRulesMeasured), 1.0f);
    EXPECT_FLOAT_EQ(outsideWeight(kInsideShare, kRulesMeasured), 1.0f);
    EXPECT_FLOAT_EQ(outsideWeight(kInsideShare + 0.5f * kInsideShareEdge, kRulesMeasured), 0.5f);
    EXPECT_FLOAT_EQ(outsideWeight(1.0f, kRulesMeasured), 0.0f);
    EXPECT_EQ(outsideWeight(1.0f, kRulesPaper), 1.0f);
    for (const int rules : {kRulesPaper, kRulesMeasured}) EXPECT_EQ(outsideWeight(kNeverUpdated, rules), 0.0f);
}

TEST(ProbeQuery, chebyshevIsOneInFrontAndFollowsItsBoundBehind) {
    const float mean = 0.4f, variance = 0.01f, square = mean * mean + variance;
    EXPECT_FLOAT_EQ(chebyshevWeight(mean, square, 0.3f, kRulesMeasured), 1.0f);
    EXPECT_FLOAT_EQ(chebyshevWeight(mean, square, 0.4f, kRulesMeasured), 1.0f);
    const float bound = variance / (variance + 0.1f * 0.1f);
    EXPECT_NEAR(chebyshevWeight(mean, square, 0.5f, kRulesMeasured), bound * bound * bound, 1e-5f);
    EXPECT_FLOAT_EQ(chebyshevWeight(mean, square, 100.0f, kRulesMeasured), 0.003f);
    EXPECT_FLOAT_EQ(chebyshevWeight(mean, square, 100.0f, kRulesPaper), 0.05f);
    // Without variance: a sharp step, and no 0 / 0.
    EXPECT_FLOAT_EQ(chebyshevWeight(0.5f, 0.25f, 0.5f, kRulesMeasured), 1.0f);
    EXPECT_FLOAT_EQ(chebyshevWeight(0.5f, 0.25f, 0.51f, kRulesMeasured), 0.003f);
}

TEST(ProbeQuery, crushIsContinuousMonotoneAndKillsTheFloor) {
    EXPECT_FLOAT_EQ(crushWeight(0.5f), 0.5f);
    EXPECT_NEAR(crushWeight(kCrushBelow * 0.99999f), kCrushBelow, 1e-4f);
    EXPECT_LT(8 * crushWeight(chebyshevFloor(kRulesPaper) * 1.20f), 0.05f);
    EXPECT_LT(8 * crushWeight(chebyshevFloor(kRulesMeasured) * 1.05f), 1e-5f);
    for (float w = 0.01f; w < 0.4f; w += 0.01f) EXPECT_LT(crushWeight(w), crushWeight(w + 0.01f));
}

// Every probe that shares a face with the cage, exactly once, and no other.
TEST(ProbeNeighbours, areThoseOfTheCagesFaces) {
    const ivec3 base(3, 5, 7);
    std::set<std::array<int, 3>> cells;
    for (int i = 0; i < kNeighbours; ++i) {
        const ivec3 at = neighbourCell(base, i) - base;
        int outside = 0;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(at[axis], -1);
            EXPECT_LE(at[axis], 2);
            outside += at[axis] < 0 || at[axis] > 1 ? 1 : 0;
        }
        EXPECT_EQ(outside, 1);
        cells.insert({at.x, at.y, at.z});
    }
    EXPECT_EQ(int(cells.size()), kNeighbours);
}

TEST(ProbeNeighbours, weightsFallWithTheFourthPowerOfDistance) {
    const vec3 up(0, 1, 0);
    const auto ahead = [&](float distance) { return neighbourWeight(1.0f, up * distance, up, 1.0f, 2.0f); };
    // (spacing / (spacing + distance))^4, times the facing of 1.05.
    EXPECT_NEAR(ahead(2.0f), 1.05f / 16, 1e-4f);
    EXPECT_NEAR(ahead(6.0f), 1.05f / 256, 1e-5f);
    EXPECT_NEAR(ahead(2.0f) / ahead(6.0f), 16.0f, 0.02f);
}

TEST(ProbeNeighbours, weightsKnowFacingVisibilityAndWalls) {
    const vec3 up(0, 1, 0);
    const float near = 1.0f / 16;
    EXPECT_NEAR(neighbourWeight(1.0f, vec3(2, 0, 0), up, 1.0f, 2.0f), 0.30f * near, 1e-5f);
    // Crushed below 0.2: a probe behind, and one in front that is hardly visible.
    EXPECT_NEAR(neighbourWeight(1.0f, vec3(0, -2, 0), up, 1.0f, 2.0f), 0.05f * 0.05f * 0.05f / 0.04f * near, 1e-6f);
    EXPECT_NEAR(neighbourWeight(1.0f, vec3(0, 2, 0), up, 0.1f, 2.0f), 0.105f * 0.105f * 0.105f / 0.04f * near, 1e-5f);
    EXPECT_NEAR(neighbourWeight(0.5f, vec3(2, 0, 0), up, 1.0f, 2.0f), 0.15f * near, 1e-5f);
    EXPECT_EQ(neighbourWeight(0.0f, vec3(2, 0, 0), up, 1.0f, 2.0f), 0.0f);
}

TEST(ProbeNeighbours, beyondTheFarthestDistanceNothingIsKnown) {
    EXPECT_EQ(neighbourVisibility(0.9f, 0.82f, 0.8f), 1.0f);
    EXPECT_EQ(neighbourVisibility(0.9f, 0.82f, 0.99f), chebyshevWeight(0.9f, 0.82f, 0.99f, kRulesMeasured));
    EXPECT_EQ(neighbourVisibility(1.0f, 1.0f, 1.0f), chebyshevFloor(kRulesMeasured));
}

// At the limit of doubt only the cage counts, at weight 0 only the neighbours; in between, roots of light are mixed.
TEST(ProbeNeighbours, theAnswerIsContinuousAtTheLimitOfDoubt) {
    const vec3 cage(0.7f, 1.0f, 0.0f), neighbours = kPi * vec3(4, 9, 16);
    const vec3 alone = completedByNeighbours(cage * kDoubtful, kDoubtful, neighbours);
    const vec3 none = completedByNeighbours(vec3(0.0f), 0.0f, neighbours);
    const vec3 half = completedByNeighbours(cage * (0.5f * kDoubtful), 0.5f * kDoubtful, neighbours);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(alone[c], kPi * cage[c] * cage[c], 1e-4f);
        EXPECT_NEAR(none[c], neighbours[c], 1e-3f);
        const float root = 0.5f * (cage[c] + std::sqrt(neighbours[c] / kPi));
        EXPECT_NEAR(half[c], kPi * root * root, 1e-3f);
    }
}

TEST(SurfaceGradient, theAxisIsTheNormalsLargest) {
    EXPECT_EQ(dominantAxis(vec3(-0.8f, 0.5f, 0.3f)), 0);
    EXPECT_EQ(dominantAxis(vec3(0.1f, 0.9f, -0.4f)), 1);
    EXPECT_EQ(dominantAxis(vec3(0.1f, 0.2f, -0.97f)), 2);
    EXPECT_FLOAT_EQ(axisTrust(vec3(0, -1, 0)), 1.0f);
    EXPECT_FLOAT_EQ(axisTrust(vec3(0.7f, 0.7f, 0.1f)), 0.0f);  // where the largest axis changes, none is trusted
    EXPECT_NEAR(axisTrust(vec3(0.7f, -0.7f - 0.5f * kAxisLead, 0.0f)), 0.5f, 1e-4f);
}

TEST(SurfaceGradient, takesWhatTheGradientPredicts) {
    // A slope of 0.1 at a root of 1, half a cell ahead: 0.05, damped by 1 / (1 + 0.1).
    const float s = 0.1f;
    EXPECT_NEAR(rootAtSurface(1.0f, 0.02f, 0.2f, 0.5f, 1.0f), 1.0f - 0.5f * s / (1.0f + s), 1e-6f);
    // Trusted by half: because of the normal, and of the weight of the pairs.
    EXPECT_NEAR(rootAtSurface(1.0f, 0.02f, 0.2f, 0.5f, 0.5f), 1.0f - 0.25f * s / (1.0f + s), 1e-6f);
    const float half = 0.5f * kTrustedWeight;
    EXPECT_NEAR(rootAtSurface(1.0f, 0.1f * half, half, 0.5f, 1.0f), 1.0f - 0.25f * s / (1.0f + s), 1e-6f);
    EXPECT_FLOAT_EQ(cellsAhead(0.6f, 2.0f, -0.5f), 0.6f);
    EXPECT_EQ(cellsAhead(-0.6f, 2.0f, 1.0f), 0.0f);
}

TEST(SurfaceGradient, neverAddsAndNeverTakesMoreThanItsShare) {
    EXPECT_EQ(rootAtSurface(1.0f, 0.0f, 0.2f, 0.5f, 1.0f), 1.0f);
    EXPECT_EQ(rootAtSurface(1.0f, -0.1f, 0.2f, 0.5f, 1.0f), 1.0f);
    EXPECT_EQ(rootAtSurface(0.0f, 0.1f, 0.2f, 0.5f, 1.0f), 0.0f);
    EXPECT_EQ(rootAtSurface(1.0f, 0.0f, 0.0f, 0.5f, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(rootAtSurface(2.0f, 1e6f, 1.0f, 1.5f, 1.0f), 2.0f * (1.0f - kMaxTaken));
    // Differences below 1 % are taken for noise, which would only darken; at 1.5 %, half of the difference counts.
    EXPECT_EQ(rootAtSurface(1.0f, 0.009f, 1.0f, 0.5f, 1.0f), 1.0f);
    EXPECT_NEAR(rootAtSurface(1.0f, 0.015f, 1.0f, 1.0f, 1.0f), 1.0f - 0.0075f / 1.0075f, 1e-6f);
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

}  // namespace
}  // namespace probegi::kernels
