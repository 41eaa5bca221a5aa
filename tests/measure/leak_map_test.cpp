#include "probegi/measure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi {
namespace {

constexpr int kWidth = 64, kHeight = 32;  // tiles of 8 x 8 pixels

/// A room with a dark left and a lit right half, and a reference with an error of a hundredth.
struct Pictures {
    HdrImage truth{kWidth, kHeight, glm::vec3(0.5f)};
    HdrImage error{kWidth, kHeight, glm::vec3(0.0002f)};
    HdrImage indirect;

    Pictures() {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth / 2; ++x) truth.at(x, y) = glm::vec3(0.02f);
        indirect = truth;
    }
    void light(int tileX, int tileY, float factor) {
        for (int y = 8 * tileY; y < 8 * tileY + 8; ++y)
            for (int x = 8 * tileX; x < 8 * tileX + 8; ++x) indirect.at(x, y) *= factor;
    }
    LeakMap map(float exposure = 1) const { return findLeaks({indirect, indirect, truth, error, exposure}).value(); }
};

TEST(LeakMap, NothingLeaksWhereNothingDiffers) {
    const LeakMap map = Pictures().map();
    EXPECT_EQ(map.tiles, 32);
    EXPECT_EQ(map.leaks, 0);
    EXPECT_EQ(map.worst, 1);
    for (const glm::vec3& ratio : map.ratio.pixels) EXPECT_EQ(ratio.x, 1);
}

TEST(LeakMap, ALeakIsFoundWhereItIs) {
    Pictures pictures;
    pictures.light(1, 2, 5);
    pictures.light(3, 1, 3);
    const LeakMap map = pictures.map();
    EXPECT_EQ(map.leaks, 2);
    EXPECT_NEAR(map.worst, 5, 1e-4);
    EXPECT_EQ(map.where, glm::ivec2(12, 20));
    EXPECT_NEAR(map.ratio.at(12, 20).x, 5, 1e-4);
    EXPECT_EQ(map.ratio.at(40, 20).x, 1);
    const glm::vec3 marked = map.picture.at(12, 20);
    EXPECT_GT(marked.x, 5 * marked.y) << "red";
}

TEST(LeakMap, BrighterIsNoLeakUnlessItIsTwiceAndSeen) {
    Pictures pictures;
    pictures.light(0, 0, 1.9f);
    pictures.light(6, 0, 1.5f);
    EXPECT_EQ(pictures.map().leaks, 0);
    EXPECT_NEAR(pictures.map().ratio.at(50, 3).x, 1.5f, 1e-4f) << "but it is shown";
    pictures.light(0, 3, 5);
    EXPECT_EQ(pictures.map().leaks, 1);
    EXPECT_EQ(pictures.map(1e-3f).leaks, 0) << "too dark to be seen";
    const glm::vec3 unseen = pictures.map(1e-5f).picture.at(4, 28);
    EXPECT_NEAR(unseen.x, unseen.z, 1e-3f) << "and so it is not painted";
}

TEST(LeakMap, TooLittleLightIsNoLeak) {
    Pictures pictures;
    pictures.light(6, 2, 0.1f);
    const LeakMap map = pictures.map();
    EXPECT_EQ(map.leaks, 0);
    const glm::vec3 marked = map.picture.at(50, 20);
    EXPECT_GT(marked.z, 2 * marked.x) << "blue";
}

TEST(LeakMap, NoiseIsNoLeak) {
    Pictures pictures;
    pictures.light(1, 1, 3);
    pictures.error = HdrImage(kWidth, kHeight, glm::vec3(0.2f));  // 0.025 in the mean of 64 pixels
    EXPECT_EQ(pictures.map().leaks, 0);
    EXPECT_EQ(pictures.map().ratio.at(12, 12).x, 1);
}

TEST(LeakMap, RatiosToBlackAreLimited) {
    Pictures pictures;
    pictures.truth = pictures.error = HdrImage(kWidth, kHeight);
    const LeakMap map = pictures.map();
    EXPECT_EQ(map.leaks, 32);
    EXPECT_EQ(map.worst, kLargestRatio);
}

TEST(LeakMap, whatCannotBeComparedIsRefused) {
    Pictures smaller, broken;
    smaller.truth = HdrImage(kWidth, kHeight - 1);
    broken.error.at(3, 4).y = NAN;
    const auto refusal = [](const Pictures& p, float exposure) {
        const auto result = findLeaks({p.indirect, p.indirect, p.truth, p.error, exposure});
        return !result && result.error().code == ErrorCode::invalidArgument;
    };
    EXPECT_TRUE(refusal(smaller, 1));
    EXPECT_TRUE(refusal(broken, 1));
    EXPECT_TRUE(refusal(Pictures(), 0));
    EXPECT_FALSE(refusal(Pictures(), 1));
}

}  // namespace
}  // namespace probegi
