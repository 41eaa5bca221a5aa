#include <gtest/gtest.h>

#include <cmath>

#include "probegi/measure.h"

namespace probegi {
namespace {

using Light = std::vector<double>;

TEST(Flicker, isTheStandardDeviationOverTheMean) {
    // One point does not change, one alternates by a half, one by a tenth: 0, 0.5 and 0.1.
    const std::vector<Light> updates{{2, 1.5, 0.9}, {2, 0.5, 1.1}, {2, 1.5, 0.9}, {2, 0.5, 1.1}};
    const auto flicker = measureFlicker(updates);
    ASSERT_TRUE(flicker);
    EXPECT_NEAR(flicker->mean, 0.6 / 3, 1e-12);
    EXPECT_NEAR(flicker->high, 0.5, 1e-12);
}

TEST(Flicker, pointsWithNextToNoLightAreLeftOut) {
    EXPECT_NEAR(measureFlicker(std::vector<Light>{{1, 0.001}, {1, 0.003}})->mean, 0, 1e-12);
    EXPECT_NEAR(measureFlicker(std::vector<Light>{{1, 0.1}, {1, 0.3}})->mean, 0.25, 1e-12);
    EXPECT_EQ(measureFlicker(std::vector<Light>{{0, 0}, {0, 0}})->mean, 0);
    EXPECT_EQ(measureFlicker({})->mean, 0);
}

TEST(Flicker, updatesOfUnequalLengthAreRefused) {
    const auto refused = measureFlicker(std::vector<Light>{{1, 2}, {1}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
}

TEST(ShareLeft, fromStartToGoalAndBeyond) {
    const Light start{1, 4, 0.2}, goal{2, 1, 0.2};
    for (const double left : {1.0, 0.5, 0.1, 0.0, -0.25}) {
        Light now;
        for (std::size_t i = 0; i < start.size(); ++i) now.push_back(goal[i] + left * (start[i] - goal[i]));
        EXPECT_NEAR(*shareLeft(now, start, goal), left, 1e-12);
    }
}

// Both change by half of their light: the dark point, which has arrived, counts as much as the bright one, which has
// not.
TEST(ShareLeft, everyPointCountsByItsOwnLight) {
    EXPECT_NEAR(*shareLeft(Light{0.05, 2}, Light{0.1, 2}, Light{0.05, 1}), 0.5, 1e-12);
}

TEST(ShareLeft, nothingIsLeftWhereNothingChanges) {
    EXPECT_EQ(*shareLeft(Light{3}, Light{1}, Light{1}), 0);
    EXPECT_EQ(*shareLeft(Light{0}, Light{0}, Light{0}), 0);
    EXPECT_EQ(*shareLeft({}, {}, {}), 0);
    EXPECT_FALSE(shareLeft(Light{1}, Light{1, 2}, Light{1}));
}

}  // namespace
}  // namespace probegi
