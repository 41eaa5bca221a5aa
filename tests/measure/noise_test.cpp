#include <gtest/gtest.h>

#include <cmath>

#include "probegi/measure.h"

namespace probegi {
namespace {

TEST(RelativeNoise, byHand) {
    HdrImage picture(2, 1, glm::vec3(1)), error(2, 1, glm::vec3(0.1f));
    picture.at(1, 0) = glm::vec3(3);
    EXPECT_NEAR(*relativeNoise(picture, error), 0.1 / 2, 1e-7);
    EXPECT_EQ(*relativeNoise(HdrImage(2, 1), error), 0) << "black";
    EXPECT_FALSE(relativeNoise(picture, HdrImage(1, 2)));
}

TEST(NoiseFloor, ofAPictureWithoutNoiseIsZero) {
    const auto floor = noiseFloor(HdrImage(9, 7, glm::vec3(0.3f)), HdrImage(9, 7), 1);
    ASSERT_TRUE(floor);
    EXPECT_EQ(floor->difference.rmse, 0);
    EXPECT_EQ(floor->difference.flip, 0);
    EXPECT_EQ(floor->difference.ratio.mean, 1);
}

// The square of the noise is its variance: relMSE of a grey picture of value v with error s is s^2 / (v^2 + 0.01).
TEST(NoiseFloor, relmseIsTheVariance) {
    const auto floor = noiseFloor(HdrImage(200, 150, glm::vec3(2)), HdrImage(200, 150, glm::vec3(0.1f)), 7);
    ASSERT_TRUE(floor);
    // 30,000 samples: a standard error of sqrt(2 / 30000) of the variance.
    EXPECT_NEAR(floor->difference.relmse, 0.01 / 4.01, 4 * 0.0082 * 0.01 / 4.01);
    const auto again = noiseFloor(HdrImage(200, 150, glm::vec3(2)), HdrImage(200, 150, glm::vec3(0.1f)), 7);
    EXPECT_EQ(again->difference.relmse, floor->difference.relmse) << "one seed, one result";
}

// Light is never negative: half of the noise on black is clipped.
TEST(NoiseFloor, lightIsNotNegative) {
    const auto floor = noiseFloor(HdrImage(200, 150), HdrImage(200, 150, glm::vec3(0.1f)), 3);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->difference.relmse, 0.5, 4 * 0.5 * std::sqrt(5.0 / 30000));
}

TEST(NoiseFloor, picturesOfOtherSizesAreRefused) {
    const auto floor = noiseFloor(HdrImage(2, 2), HdrImage(2, 3), 1);
    ASSERT_FALSE(floor);
    EXPECT_EQ(floor.error().code, ErrorCode::invalidArgument);
}

}  // namespace
}  // namespace probegi
