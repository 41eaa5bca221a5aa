#include "kernels/light/punctual_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi::kernels {
namespace {

constexpr float kNoRange = 0.0f;

LightSample pointLight(vec3 at, vec3 point, float range = kNoRange) {
    return samplePunctual(kLightPoint, at, {0, 0, -1}, {8, 4, 0}, range, 1, 0, point);
}

TEST(PunctualLight, thePointsLightFallsWithTheSquareOfTheDistance) {
    const LightSample s = pointLight({1, 5, 1}, {1, 1, 1});
    EXPECT_EQ(s.toLight, vec3(0, 1, 0));
    EXPECT_EQ(s.distance, 4.0f);
    EXPECT_FLOAT_EQ(s.irradianceAtNormal.x, 0.5f);
    EXPECT_FLOAT_EQ(s.irradianceAtNormal.y, 0.25f);
    EXPECT_NEAR(length(pointLight({4, 5, 1}, {1, 1, 1}).toLight - vec3(0.6f, 0.8f, 0)), 0, 1e-6);
    EXPECT_FLOAT_EQ(pointLight({4, 5, 1}, {1, 1, 1}).distance, 5.0f);
}

TEST(PunctualLight, theSunIsTheSameEverywhere) {
    for (const vec3 point : {vec3(0.0f), vec3(3, -2, 1e6f)}) {
        const LightSample s = samplePunctual(kLightDirectional, vec3(7.0f), {0, -1, 0}, {3, 2, 1}, 5, 1, 0, point);
        EXPECT_EQ(s.toLight, vec3(0, 1, 0));
        EXPECT_EQ(s.distance, kLightAtInfinity);
        EXPECT_EQ(s.irradianceAtNormal, vec3(3, 2, 1));
    }
    EXPECT_GT(kLightAtInfinity, 1e27f);
    EXPECT_LT(kLightAtInfinity, 1e30f) << "Ray::far";
}

TEST(PunctualLight, isZeroAtItsOwnPosition) {
    const LightSample s = pointLight({1, 2, 3}, {1, 2, 3});
    EXPECT_EQ(s.irradianceAtNormal, vec3(0.0f));
    EXPECT_EQ(s.distance, 0.0f);
    EXPECT_EQ(s.toLight, vec3(0, 1, 0));
    // There is light a nanometre away: only the exact position has none.
    EXPECT_GT(pointLight({1e-9f, 0, 0}, {0, 0, 0}).irradianceAtNormal.x, 1e18f);
}

TEST(PunctualLight, theRangeEndsInAWindow) {
    EXPECT_EQ(punctualRangeWindow(3, 0), 1.0f);
    EXPECT_EQ(punctualRangeWindow(3, -1), 1.0f);
    EXPECT_FLOAT_EQ(punctualRangeWindow(1, 2), 15.0f / 16);
    EXPECT_EQ(punctualRangeWindow(0, 2), 1.0f);
    EXPECT_EQ(punctualRangeWindow(2, 2), 0.0f);
    EXPECT_EQ(punctualRangeWindow(9, 2), 0.0f);
    EXPECT_FLOAT_EQ(pointLight({0, 1, 0}, {0, 0, 0}, 2).irradianceAtNormal.x, 8 * 15.0f / 16);
    EXPECT_FLOAT_EQ(pointLight({0, 2, 0}, {0, 0, 0}, 4).irradianceAtNormal.x, 2 * 15.0f / 16);
}

TEST(PunctualLight, theConesRampIsSquared) {
    EXPECT_EQ(punctualConeFactor(0.9f, 0.8f, 0.4f), 1.0f);
    EXPECT_EQ(punctualConeFactor(0.8f, 0.8f, 0.4f), 1.0f);
    EXPECT_FLOAT_EQ(punctualConeFactor(0.6f, 0.8f, 0.4f), 0.25f);
    EXPECT_EQ(punctualConeFactor(0.4f, 0.8f, 0.4f), 0.0f);
    EXPECT_EQ(punctualConeFactor(-1.0f, 0.8f, 0.4f), 0.0f);
    // Coinciding cones: an edge of a thousandth.
    EXPECT_NEAR(punctualConeFactor(0.5005f, 0.5f, 0.5f), 0.25f, 1e-3f);
}

TEST(PunctualLight, spotsShineAlongTheirAxis) {
    const auto spot = [](int type, vec3 point) {
        return samplePunctual(type, vec3(0.0f), {0, -1, 0}, vec3(5.0f), kNoRange, 0.8f, 0.4f, point)
            .irradianceAtNormal.x;
    };
    EXPECT_FLOAT_EQ(spot(kLightSpot, {0, -2, 0}), 1.25f);
    EXPECT_EQ(spot(kLightSpot, {0, 2, 0}), 0.0f);
    EXPECT_NEAR(spot(kLightSpot, {4, -3, 0}), 0.25f * 0.2f, 1e-6f) << "cosine 0.6";
    EXPECT_FLOAT_EQ(spot(kLightPoint, {0, 2, 0}), 1.25f);
}

TEST(PunctualLight, surfacesGetLightFromInFrontOfBothNormalsOnly) {
    const auto reaches = [](vec3 toLight, vec3 irradiance) {
        return reachesSurface({toLight, 1, irradiance}, {0, 0, 1}, {0.8f, 0, 0.6f});
    };
    const vec3 white(1.0f);
    EXPECT_TRUE(reaches({0, 0, 1}, white));
    EXPECT_TRUE(reaches({1, 0, 1e-6f}, white));
    EXPECT_FALSE(reaches({1, 0, 0}, white)) << "along the surface";
    EXPECT_FALSE(reaches({1, 0, -0.1f}, white)) << "behind it, and in front of the shading normal";
    EXPECT_FALSE(reaches({-1, 0, 0.1f}, white)) << "behind the shading normal";
    EXPECT_FALSE(reaches({0, 1, 0}, white)) << "along both";
    EXPECT_FALSE(reaches({0, 0, 1}, vec3(0.0f)));
    EXPECT_FALSE(reaches({0, 0, 1}, vec3(-1.0f)));
    for (int channel = 0; channel < 3; ++channel) {
        vec3 one(0.0f);
        one[channel] = 1e-30f;
        EXPECT_TRUE(reaches({0, 0, 1}, one));
    }
    const float nan = std::nanf("");
    EXPECT_FALSE(reaches({0, 0, 1}, vec3(nan)));
    EXPECT_FALSE(reaches(vec3(nan), white));
    EXPECT_FALSE(reachesSurface({{0, 0, 1}, 1, white}, vec3(nan), {0, 0, 1}));
    EXPECT_FALSE(reachesSurface({{0, 0, 1}, 1, white}, {0, 0, 1}, vec3(nan)));
}

}  // namespace
}  // namespace probegi::kernels
