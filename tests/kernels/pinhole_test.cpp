#include "kernels/screen/pinhole.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi::kernels {
namespace {

// A vertical angle of 90 degrees, twice as wide, looking along -Z from (1, 2, 3): the plane at distance 1 is 4 x 2.
const PinholeCamera kCamera = makePinhole({1, 2, 3}, {0, 0, -1}, {0, 1, 0}, 0.5f * kPi, 200, 100);

void expectDirection(float x, float y, vec3 towards) {
    EXPECT_NEAR(length(pinholeDirection(kCamera, x, y) - normalize(towards)), 0, 1e-6) << x << ' ' << y;
}

TEST(Pinhole, cornersAreWhereTheAngleSays) {
    EXPECT_EQ(kCamera.origin, vec3(1, 2, 3));
    expectDirection(0, 0, {-2, 1, -1});
    expectDirection(200, 0, {2, 1, -1});
    expectDirection(0, 100, {-2, -1, -1});
    expectDirection(200, 100, {2, -1, -1});
    expectDirection(100, 50, {0, 0, -1});
    expectDirection(100.5f, 49.5f, {0.01f, 0.01f, -1});
}

TEST(Pinhole, anglesAreVertical) {
    const float yfov = 0.6f;
    const PinholeCamera tall = makePinhole(vec3(0.0f), {1, 0, 0}, {0, 0, 1}, yfov, 30, 90);
    EXPECT_NEAR(std::acos(dot(pinholeDirection(tall, 15, 0), vec3(1, 0, 0))), yfov / 2, 1e-5);
    // Forward x up is right: from above, +X ahead has -Y on its right.
    EXPECT_LT(pinholeDirection(tall, 30, 45).y, 0.0f);
}

TEST(Pinhole, spreadIsThatOfARayAcrossAPixel) {
    EXPECT_NEAR(pinholeSpread(kCamera, 1), 2.0f / 100, 1e-6f);
    EXPECT_NEAR(pinholeSpread(kCamera, 4), 2.0f / 400, 1e-6f);
}

TEST(Pinhole, subSamplesAreRowByRowWithinThePixel) {
    EXPECT_EQ(subSampleDirection(kCamera, 7, 5, 0, 1), pinholeDirection(kCamera, 7.5f, 5.5f));
    EXPECT_EQ(subSampleDirection(kCamera, 7, 5, 1, 2), pinholeDirection(kCamera, 7.75f, 5.25f));
    EXPECT_EQ(subSampleDirection(kCamera, 7, 5, 2, 2), pinholeDirection(kCamera, 7.25f, 5.75f));
}

}  // namespace
}  // namespace probegi::kernels
