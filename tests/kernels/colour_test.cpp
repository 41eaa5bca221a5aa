#include "kernels/screen/colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi::kernels {
namespace {

// ITU-R BT.709-6, section 3.2: white is 1, and green has the largest weight.
TEST(Luminance, isThatOfRec709) {
    EXPECT_NEAR(luminance(vec3(1.0f)), 1.0f, 1e-6f);
    EXPECT_FLOAT_EQ(luminance({1, 0, 0}), 0.2126f);
    EXPECT_FLOAT_EQ(luminance({0, 1, 0}), 0.7152f);
    EXPECT_FLOAT_EQ(luminance({0, 0, 1}), 0.0722f);
    EXPECT_NEAR(luminance({1, 2, 3}), 0.2126f + 2 * 0.7152f + 3 * 0.0722f, 1e-6f);
}

TEST(AnyPositive, oneChannelIsEnoughAndNanIsNot) {
    EXPECT_FALSE(anyPositive(vec3(0.0f)));
    EXPECT_FALSE(anyPositive({-1, -2, 0}));
    EXPECT_FALSE(anyPositive(vec3(std::nanf(""))));
    for (int channel = 0; channel < 3; ++channel) {
        vec3 color(-1.0f);
        color[channel] = 1e-30f;
        EXPECT_TRUE(anyPositive(color)) << channel;
    }
}

// IEC 61966-2-1: known pairs on both pieces, and where they meet.
TEST(Srgb, knownValuesBothWays) {
    const float pairs[][2] = {{0, 0},
                              {0.002f, 0.02584f},
                              {0.0031308f, 0.0404499f},
                              {0.0031309f, 0.0404511f},
                              {0.0100228f, 0.1f},
                              {0.2140411f, 0.5f},
                              {1, 1}};
    for (const auto& [linear, display] : pairs) {
        EXPECT_NEAR(encodeSrgb(linear), display, 2e-6f) << linear;
        EXPECT_NEAR(decodeSrgb(display), linear, 1e-6f) << display;
    }
    // The line and the power are 1e-8 apart at the standard's limit, and 0.3 % on either side of it.
    EXPECT_NEAR(encodeSrgb(0.004f), 1.055 * std::pow(0.004, 1 / 2.4) - 0.055, 1e-7);
    EXPECT_NEAR(decodeSrgb(0.05f), std::pow((0.05 + 0.055) / 1.055, 2.4), 1e-8);
    EXPECT_FLOAT_EQ(decodeSrgb(0.03f), 0.03f / 12.92f);
}

}  // namespace
}  // namespace probegi::kernels
