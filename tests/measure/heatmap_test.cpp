#include <gtest/gtest.h>

#include <limits>

#include "measure/colour_spaces.h"
#include "probegi/measure.h"

namespace probegi {
namespace {

HdrImage ramp(int steps) {
    HdrImage values(steps, 1);
    for (int i = 0; i < steps; ++i) values.at(i, 0) = glm::vec3(float(i) / float(steps - 1));
    return values;
}

TEST(Heatmap, lightnessRisesWithTheValue) {
    const HdrImage colours = heatmap(ramp(256));
    float last = -1;
    for (int i = 0; i < 256; ++i) {
        const glm::vec3 display = colours.at(i, 0);
        const float lightness = colour::labFromXyz(colour::xyzFromRgb(colour::decodeSrgb(display))).x;
        EXPECT_GT(lightness, last) << "at " << i;
        EXPECT_LT(lightness - last, 6) << "a jump at " << i;
        last = lightness;
    }
    EXPECT_GT(last, 90);
}

TEST(Heatmap, coloursAreOnTheScreen) {
    for (const glm::vec3& c : heatmap(ramp(256)).pixels)
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_GE(c[channel], 0);
            EXPECT_LE(c[channel], 1);
        }
}

TEST(Heatmap, clampsWhatIsOutside) {
    HdrImage odd(3, 1);
    odd.at(0, 0) = glm::vec3(-4);
    odd.at(1, 0) = glm::vec3(9);
    odd.at(2, 0) = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    const HdrImage colours = heatmap(odd);
    const HdrImage ends = heatmap(ramp(2));
    EXPECT_EQ(colours.at(0, 0), ends.at(0, 0));
    EXPECT_EQ(colours.at(1, 0), ends.at(1, 0));
    EXPECT_EQ(colours.at(2, 0), ends.at(0, 0));
}

TEST(Heatmap, linearFromDisplayInvertsTheToneMap) {
    const HdrImage display = ramp(64);
    const HdrImage linear = linearFromDisplay(display);
    for (int i = 0; i < 64; ++i) EXPECT_NEAR(toDisplay(linear.at(i, 0), {}).y, display.at(i, 0).y, 1e-5);
}

TEST(Colour, whiteIsWhite) {
    const glm::vec3 lab = colour::labFromXyz(colour::xyzFromRgb(glm::vec3(1)));
    EXPECT_NEAR(lab.x, 100, 1e-3);
    EXPECT_NEAR(lab.y, 0, 1e-3);
    EXPECT_NEAR(lab.z, 0, 1e-3);
}

TEST(Colour, primariesInLab) {
    // The usual CIELAB values of the sRGB primaries.
    const glm::vec3 red = colour::labFromXyz(colour::xyzFromRgb({1, 0, 0}));
    EXPECT_NEAR(red.x, 53.24, 0.1);
    EXPECT_NEAR(red.y, 80.09, 0.3);
    EXPECT_NEAR(red.z, 67.20, 0.3);
    const glm::vec3 blue = colour::labFromXyz(colour::xyzFromRgb({0, 0, 1}));
    EXPECT_NEAR(blue.x, 32.30, 0.1);
    EXPECT_NEAR(blue.y, 79.19, 0.3);
    EXPECT_NEAR(blue.z, -107.86, 0.3);
}

TEST(Colour, roundTrips) {
    for (const glm::vec3& rgb : {glm::vec3(0.2f, 0.7f, 0.4f), glm::vec3(0.001f, 0.0f, 0.9f), glm::vec3(0)}) {
        const glm::vec3 xyz = colour::xyzFromRgb(rgb);
        for (const glm::vec3& back :
             {colour::rgbFromXyz(xyz), colour::rgbFromXyz(colour::xyzFromLab(colour::labFromXyz(xyz))),
              colour::rgbFromXyz(colour::xyzFromYcxcz(colour::ycxczFromXyz(xyz))),
              colour::decodeSrgb(colour::encodeSrgb(rgb))})
            for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(back[channel], rgb[channel], 1e-4);
    }
}

}  // namespace
}  // namespace probegi
