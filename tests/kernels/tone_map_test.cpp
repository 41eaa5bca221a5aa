#include "kernels/screen/tone_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace probegi::kernels {
namespace {

TEST(FilmicShoulder, joinsTheIdentityWithItsSlopeAndEndsAtOne) {
    EXPECT_EQ(filmicShoulder(0.3f), 0.3f);
    EXPECT_EQ(filmicShoulder(kShoulderStart), kShoulderStart);
    EXPECT_NEAR((filmicShoulder(kShoulderStart + 1e-2f) - kShoulderStart) / 1e-2f, 1, 0.02);
    EXPECT_NEAR(filmicShoulder(1.0f), 1 - 0.4 * std::exp(-1.0), 1e-6);
    EXPECT_NEAR(filmicShoulder(50.0f), 1, 1e-6);
}

TEST(FilmicCurve, leavesTheDarkAloneAndBleachesTheBright) {
    EXPECT_EQ(filmicCurve({0.6f, 0.2f, 0.1f}), vec3(0.6f, 0.2f, 0.1f));
    const vec3 v = filmicCurve({2, 1, 0.5f});
    EXPECT_NEAR(v.x, 0.987921, 1e-5);  // the shoulder of 2
    EXPECT_NEAR(v.y, 0.559066, 1e-5);  // half of that, bleached by 13 %
    EXPECT_NEAR(v.z, 0.344638, 1e-5);
    for (int peak = 0; peak < 3; ++peak) {  // for each channel as the largest
        vec3 one(0.25f);
        one[peak] = 4;
        EXPECT_NEAR(filmicCurve(one)[peak], filmicShoulder(4), 1e-6);
    }
}

TEST(Displayable, isFiniteAndNotNegative) {
    EXPECT_EQ(displayable(0.3f), 0.3f);
    EXPECT_EQ(displayable(-0.3f), 0.0f);
    EXPECT_EQ(displayable(std::nanf("")), 0.0f);
    EXPECT_EQ(displayable(std::numeric_limits<float>::infinity()), kDisplayableLimit);
}

TEST(ToneMap, exposesThenClipsThenEncodes) {
    const vec3 v = toneMap({0.10702055f, 0.5f, 7}, 2, false);
    EXPECT_NEAR(v.x, 0.5f, 1e-6);
    EXPECT_NEAR(v.y, 1.0f, 1e-6);
    EXPECT_NEAR(v.z, 1.0f, 1e-6);
    EXPECT_NEAR(toneMap(vec3(1.0f), 1, true).y, encodeSrgb(filmicShoulder(1)), 1e-6) << "grey stays grey";
    EXPECT_EQ(toneMap({-1, std::nanf(""), 0}, 1, true), vec3(0.0f));
}

// Bayer's matrix: its first rows as published, each level once, repeating every 8 pixels.
TEST(DitherThreshold, isBayersMatrix) {
    const int rows[2][8] = {{0, 32, 8, 40, 2, 34, 10, 42}, {48, 16, 56, 24, 50, 18, 58, 26}};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(ditherThreshold(x, y), (float(rows[y][x]) + 0.5f) / 64) << x << ' ' << y;
    std::array<int, 64> seen{};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const float threshold = ditherThreshold(x, y);
            EXPECT_EQ(threshold, ditherThreshold(x + 16, y + 8));
            ++seen[std::size_t(threshold * 64)];
        }
    for (const int count : seen) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace probegi::kernels
