#include "kernels/blend/probe_blend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernels/trace/ray_set.h"

namespace probegi::kernels {
namespace {

const float kNan = std::nanf("");
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(RayDatum, onlyUsableRadianceIsSafe) {
    for (const float good : {0.0f, 1e-38f, 1.0f, 0.999e30f}) EXPECT_EQ(safeRadiance(good), good);
    for (const float bad : {kNan, -kNan, kInfinity, -kInfinity, -1e-30f, 1e30f, 3e38f}) EXPECT_EQ(safeRadiance(bad), 0);
}

TEST(RayDatum, anInvalidDistanceIsAMiss) {
    for (const float good : {0.0f, -3.0f, 1e30f, kInfinity, -kInfinity}) EXPECT_EQ(safeDistance(good), good);
    for (const float bad : {kNan, -kNan}) EXPECT_GE(safeDistance(bad), kMissDistance);
}

TEST(RayDatum, signsTellWhichSideWasMet) {
    EXPECT_FALSE(hitBack(2));
    EXPECT_FALSE(hitBack(0.0f));
    EXPECT_TRUE(hitBack(-0.0f)) << "a surface at the probe itself";
    EXPECT_TRUE(hitBack(-2));
    EXPECT_TRUE(hitBackface(-2, 0));
    EXPECT_TRUE(hitBackface(-2, 5));
    EXPECT_FALSE(hitBackface(-2, -5)) << "two sides";
    EXPECT_FALSE(hitBackface(2, 5));
    EXPECT_FALSE(hitBackface(2, -5));
}

TEST(RayDatum, lightOfBothSidesOfASheetArrives) {
    const vec3 light(1, 2, 3);
    EXPECT_EQ(arrivingRadiance(5, light), light);
    EXPECT_EQ(arrivingRadiance(-5, light), vec3(0.0f)) << "a backface";
    EXPECT_EQ(arrivingRadiance(-5, radianceFromBack(light)), light);
    EXPECT_EQ(arrivingRadiance(5, {kNan, -1, 2}), vec3(0, 0, 2));
    // Black light from the back of a double-sided surface is not a backface.
    const vec3 black = radianceFromBack(vec3(0.0f));
    EXPECT_FALSE(hitBackface(-5, black.x));
    EXPECT_LT(arrivingRadiance(-5, black).y, 1e-29f);
}

TEST(ProbeBlend, sharesAndNormalisation) {
    EXPECT_EQ(backfaceShareOf(3, 12), 0.25f);
    EXPECT_EQ(backfaceShareOf(1, 1), 1.0f);
    EXPECT_EQ(backfaceShareOf(0, 0), 0.0f);
    EXPECT_EQ(normalisingFactor(4), 0.25f);
    EXPECT_EQ(normalisingFactor(0.5f), 2.0f);
    EXPECT_EQ(normalisingFactor(0), 0.0f);
    EXPECT_EQ(normalisingFactor(1e-21f), 0.0f) << "no ray came near";
    EXPECT_EQ(withoutBackfaces(0.3f, 0.5f), 0.6f);
    EXPECT_EQ(withoutBackfaces(0, 0), 0.0f);
}

TEST(ProbeBlend, weightsAreCosinesAndTheirPowers) {
    const vec3 n(0, 0, 1), w(0.6f, 0, 0.8f);
    EXPECT_FLOAT_EQ(irradianceWeight(n, w), 0.8f);
    EXPECT_EQ(irradianceWeight(n, -w), 0.0f);
    EXPECT_FLOAT_EQ(visibilityWeight(n, w, 3), 0.512f);
    EXPECT_EQ(visibilityWeight(n, -w, 3), 0.0f);
}

// Weights below 1e-8 of the largest are left out.
TEST(ProbeBlend, negligibleWeightsAreAHundredMillionthOfTheLargest) {
    for (const float exponent : {50.0f, 100.0f}) {
        const float least = leastVisibilityCosine(0.9f, exponent);
        EXPECT_NEAR(std::pow(double(least) / 0.9, double(exponent)) / 1e-8, 1, 1e-4);
    }
    EXPECT_EQ(leastVisibilityCosine(-0.5f, 50), 0.0f);
}

TEST(ProbeBlend, distancesAreSharesOfTheFarthest) {
    EXPECT_FLOAT_EQ(visibilityDistance(1, 4), 0.25f);
    EXPECT_FLOAT_EQ(visibilityDistance(9, 4), 1);
    EXPECT_FLOAT_EQ(visibilityDistance(-1, 4), 0.05f);
    EXPECT_FLOAT_EQ(visibilityDistance(-kInfinity, 4), 1);
    EXPECT_EQ(visibilityDistance(0, 4), 0.0f);
}

// Each channel is blended separately; the hysteresis is the share of the old value.
TEST(ProbeBlend, channelsAreBlendedApart) {
    const vec3 old(1, 2, 0.5f), mean(32, 1, 0);  // roots 2, 1, 0
    const vec3 encoded = blendEncoded(old, mean, {0.75f, 0, 0});
    EXPECT_NEAR(encoded.x, 0.75f * 1 + 0.25f * 2, 1e-6);
    EXPECT_NEAR(encoded.y, 0.75f * 2 + 0.25f * 1, 1e-6);
    EXPECT_NEAR(encoded.z, 0.75f * 0.5f, 1e-6);
    const vec3 linear = blendLinear(old, mean, 0.75f);
    EXPECT_NEAR(linear.x, std::pow(0.75 * 1 + 0.25 * 32, 0.2), 1e-6);
    EXPECT_NEAR(linear.y, std::pow(0.75 * 32 + 0.25 * 1, 0.2), 1e-6);
    EXPECT_NEAR(linear.z, std::pow(0.75 / 32, 0.2), 1e-6);
}

// Listing 3 compares the channel that changes most with the texel's largest value.
TEST(ProbeBlend, anyChannelMayTripTheThresholds) {
    const BlendRule rule{0.9f, 0.25f, 0.8f};
    for (int c = 0; c < 3; ++c) {
        vec3 some(1.0f), most(1.0f), dark(0.0f);
        some[c] = 0.7f;
        most[c] = 0.1f;
        dark[c] = 4;
        EXPECT_FLOAT_EQ(texelHysteresis(vec3(1.0f), some, rule), 0.75f) << c;
        EXPECT_EQ(texelHysteresis(vec3(1.0f), most, rule), 0.0f) << c;
        EXPECT_EQ(texelHysteresis(dark, vec3(0.0f), rule), 0.0f) << c;
        EXPECT_EQ(texelHysteresis(vec3(0.0f), dark, rule), 0.0f) << c;
        // With light in another channel the same change is small.
        vec3 lit = some;
        lit[(c + 1) % 3] = 4;
        vec3 before(1.0f);
        before[(c + 1) % 3] = 4;
        EXPECT_FLOAT_EQ(texelHysteresis(before, lit, rule), 0.9f) << c;
    }
    EXPECT_EQ(texelHysteresis(vec3(1.0f), vec3(0.7f), BlendRule{0.1f, 0.25f, 0.8f}), 0.0f) << "never below 0";
    EXPECT_FLOAT_EQ(texelHysteresis(vec3(1.0f), vec3(0.1f), BlendRule{0.9f, 0.25f, 0}), 0.75f);
    EXPECT_EQ(texelHysteresis(vec3(1.0f), vec3(0.1f), BlendRule{0.9f, 0, 0.8f}), 0.0f);
}

// With evenly spread rays, enough to integrate the lobe, every texel has an evidence of 1.
TEST(ProbeBlend, evenRaysAreEvidenceOfOne) {
    constexpr int kRays = 20000;
    for (const float exponent : {1.0f, 50.0f, 200.0f})
        for (const vec3 texel : {vec3(0, 1, 0), normalize(vec3(1, -2, 3)), normalize(vec3(-5, 0.3f, -1))}) {
            double sum = 0;
            for (int i = 0; i < kRays; ++i)
                sum += visibilityWeight(texel, sphericalFibonacci(uint(i), uint(kRays)), exponent);
            EXPECT_NEAR(visibilityEvidence(float(sum), exponent, kRays), 1.0f, 0.01f) << exponent;
        }
    EXPECT_FLOAT_EQ(visibilityEvidence(3.0f, 9.0f, 60), 1.0f) << "3 is 60 / (2 (9 + 1))";
    EXPECT_EQ(visibilityEvidence(0.0f, 200.0f, 144), 0.0f);
}

TEST(ProbeBlend, momentsAreAveragedByWhatTheyRestOn) {
    EXPECT_FLOAT_EQ(keptMoments(0.9f, 1.0f), 0.9f);
    EXPECT_FLOAT_EQ(keptMoments(0.9f, 0.0f), 1.0f) << "no ray came near: nothing was learnt";
    EXPECT_FLOAT_EQ(keptMoments(0.9f, 2.5f), 0.75f);
    EXPECT_EQ(keptMoments(0.5f, 3.0f), 0.0f) << "never below 0";
    EXPECT_EQ(keptMoments(0.0f, 0.2f), 0.0f) << "a new probe takes what there is";
}

}  // namespace
}  // namespace probegi::kernels
