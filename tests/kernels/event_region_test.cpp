#include "kernels/blend/event_region.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

const EventRegion kBox{{0, 0, 0}, {1, 2, 3}, 0.4f, 1.0f};

TEST(EventRegion, holdsWhatIsInTheBoxItsFacesIncluded) {
    for (const glm::vec3 inside : {glm::vec3(0.5f, 1, 1), glm::vec3(0), glm::vec3(1, 2, 3), glm::vec3(1, 0, 3)})
        EXPECT_TRUE(isInRegion(kBox, inside));
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 below(0.5f), above(0.5f);
        below[axis] = -1e-6f;
        above[axis] = kBox.upper[axis] + 1e-6f;
        EXPECT_FALSE(isInRegion(kBox, below)) << axis;
        EXPECT_FALSE(isInRegion(kBox, above)) << axis;
    }
}

TEST(EventRegion, ofSeveralBoxesTheSmallestShareCounts) {
    EventLimit limit = noEventLimit();
    EXPECT_EQ(limit.irradianceKept, 1.0f);
    EXPECT_EQ(limit.visibilityKept, 1.0f);
    addEventRegion(limit, kBox, {5, 5, 5});
    EXPECT_EQ(limit.irradianceKept, 1.0f) << "outside";
    addEventRegion(limit, kBox, glm::vec3(0.5f));
    EXPECT_EQ(limit.irradianceKept, 0.4f);
    EXPECT_EQ(limit.visibilityKept, 1.0f);
    addEventRegion(limit, {{0, 0, 0}, {1, 1, 1}, 0.7f, 0.3f}, glm::vec3(0.5f));
    EXPECT_EQ(limit.irradianceKept, 0.4f);
    EXPECT_EQ(limit.visibilityKept, 0.3f);
}

// A window of 1 / (1 - h) updates keeps the share h.
TEST(EventRegion, limitsWindowsToTheHysteresis) {
    EXPECT_FLOAT_EQ(windowOfHysteresis(0.75f), 4.0f);
    EXPECT_FLOAT_EQ(limitedWindow(100, 0.75f), 4.0f);
    EXPECT_EQ(limitedWindow(3, 0.75f), 3.0f) << "a shorter one stays";
    EXPECT_EQ(limitedWindow(100, 1.0f), 100.0f) << "no limit";
    EXPECT_EQ(limitedWindow(100, 0.0f), 1.0f);
    EXPECT_FLOAT_EQ(limitedKept(0.99f, 0.75f), 0.75f);
    EXPECT_EQ(limitedKept(0.5f, 0.75f), 0.5f);
    EXPECT_EQ(limitedKept(0.99f, 1.0f), 0.99f);
    EXPECT_EQ(limitedKept(0.99f, 0.0f), 0.0f);
}

}  // namespace
}  // namespace probegi::kernels
