#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "probegi/image.h"

namespace probegi {
namespace {

TEST(AutoExposure, MiddleGreyForOneBrightness) {
    for (const float light : {1e-6f, 0.18f, 1.0f, 5e4f})
        EXPECT_NEAR(autoExposure(HdrImage(7, 5, glm::vec3(light))) * light, 0.18f, 1e-5f) << light;
}

TEST(AutoExposure, TheGeometricMeanOfHalves) {
    HdrImage image(100, 2, glm::vec3(4));
    for (int x = 0; x < 100; ++x) image.at(x, 1) = glm::vec3(1);
    // Of 200 values the 20 darkest and the 10 brightest are left out, which leaves 80 ones and 90 fours.
    EXPECT_NEAR(autoExposure(image), 0.18 / std::exp2(2.0 * 90 / 170), 1e-5);
}

TEST(AutoExposure, ALampAndACornerDoNotCount) {
    HdrImage image(10, 10, glm::vec3(1));
    for (int i = 0; i < 5; ++i) image.at(i, 0) = glm::vec3(1e6f);
    for (int i = 0; i < 5; ++i) image.at(i, 1) = glm::vec3(0);
    for (int i = 5; i < 10; ++i) image.at(i, 1) = glm::vec3(1e-6f);
    EXPECT_NEAR(autoExposure(image), 0.18f, 1e-6f);
}

// Half of the picture is the void around a model, with a faint glow.
TEST(AutoExposure, TheVoidDoesNotCount) {
    HdrImage image(10, 10, glm::vec3(2));
    for (int i = 0; i < 50; ++i) image.pixels[std::size_t(i)] = glm::vec3(1e-4f);
    EXPECT_NEAR(autoExposure(image), 0.09f, 1e-6f);
    for (int i = 0; i < 50; ++i) image.pixels[std::size_t(i)] = glm::vec3(0.02f);  // dark, but not void
    EXPECT_GT(autoExposure(image), 0.3f);
}

TEST(AutoExposure, WithoutLightItIsOne) {
    EXPECT_EQ(autoExposure({}), 1.0f);
    EXPECT_EQ(autoExposure(HdrImage(4, 4)), 1.0f);
    EXPECT_EQ(autoExposure(HdrImage(4, 4, glm::vec3(std::numeric_limits<float>::quiet_NaN()))), 1.0f);
    EXPECT_EQ(autoExposure(HdrImage(4, 4, glm::vec3(std::numeric_limits<float>::infinity()))), 1.0f);
    HdrImage one(20, 20);  // a single lit pixel counts, though it is within the brightest twentieth
    one.at(3, 3) = glm::vec3(2);
    EXPECT_NEAR(autoExposure(one), 0.09f, 1e-6f);
}

}  // namespace
}  // namespace probegi
