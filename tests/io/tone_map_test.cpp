#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "probegi/image.h"

namespace probegi {
namespace {

TEST(ToneMap, ClipsAndEncodesSrgb) {
    const ToneMap map;
    EXPECT_EQ(toDisplay(glm::vec3(0.0f), map), glm::vec3(0.0f));
    EXPECT_NEAR(toDisplay(glm::vec3(0.214041f), map).x, 0.5f, 1e-4f);  // IEC 61966-2-1
    EXPECT_NEAR(toDisplay(glm::vec3(0.002f), map).y, 0.02584f, 1e-6f);
    EXPECT_NEAR(toDisplay(glm::vec3(1.0f, 7.0f, 1e30f), map).z, 1.0f, 1e-6f);
    EXPECT_NEAR(toDisplay(glm::vec3(0.107f), {.exposure = 2.0f}).x, 0.5f, 1e-3f);
}

TEST(ToneMap, NeverLeavesZeroToOne) {
    const float worst[] = {-1.0f,
                           -0.0f,
                           1e-40f,
                           0.59f,
                           0.61f,
                           1e30f,
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN()};
    for (const bool filmic : {false, true}) {
        for (const float r : worst) {
            for (const float g : worst) {
                const glm::vec3 display = toDisplay({r, g, 0.3f}, {.exposure = 3.0f, .filmic = filmic});
                for (int c = 0; c < 3; ++c) {
                    EXPECT_GE(display[c], 0.0f) << r << " " << g;
                    EXPECT_LE(display[c], 1.0f) << r << " " << g;
                }
            }
        }
    }
}

TEST(ToneMap, FilmicIsTheIdentityInTheDarkAndRisesEverywhere) {
    const ToneMap film{.exposure = 1.0f, .filmic = true};
    EXPECT_EQ(toDisplay({0.5f, 0.3f, 0.1f}, film), toDisplay({0.5f, 0.3f, 0.1f}, {}));
    glm::vec3 previous(-1.0f);
    for (float level = 0.0f; level < 20.0f; level += 0.01f) {
        const glm::vec3 display = toDisplay(level * glm::vec3(1.0f, 0.5f, 0.2f), film);
        for (int c = 0; c < 3; ++c) EXPECT_GE(display[c], previous[c] - 1e-6f) << level;
        EXPECT_GE(display.x, display.y);  // the order of the channels, hence the hue, is kept
        EXPECT_GE(display.y, display.z);
        previous = display;
    }
    EXPECT_LT(toDisplay(glm::vec3(1.5f), film).x, 0.99f);  // a shoulder, no clipping
    EXPECT_GT(previous.z, 0.7f);                           // overexposed colours bleach
}

}  // namespace
}  // namespace probegi
