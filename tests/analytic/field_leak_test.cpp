#include <gtest/gtest.h>

#include "analytic/field_scene.h"
#include "probegi/measure.h"

namespace probegi {
namespace {

// Points on the inner faces of the room between x0 and x1 of dark-room.
std::vector<FieldQuery> innerFaces(float x0, float x1) {
    return wallPoints({{x0, 0, -2.5f}, {x1, 2.8f, 2.5f}}, 11);
}

// Light in the sealed room of dark-room over that in the sunlit one, with probes a metre apart; `shift` moves the grid,
// since leaks depend on where the walls are between probes.
double measureRooms(LeakGuard guard, float wallThickness, glm::vec3 shift) {
    test::FieldSetup desc;
    desc.guard = guard;
    test::FieldScene s(*makeBuiltinScene("dark-room", {.wallThickness = wallThickness}),
                       {glm::vec3(-7, -1.2f, -4) + shift, glm::vec3(1), {15, 6, 9}}, desc);
    EXPECT_TRUE(s.field.converge(*s.tracer, s.lighting, 1e-6f, 32));
    const float half = 0.5f * wallThickness;
    const auto lit = innerFaces(-half - 5, -half);
    EXPECT_GT(*meanLight(s.field, lit), 0.1);
    return *leakShare(s.field, innerFaces(half, half + 5), lit);
}

constexpr glm::vec3 kShifts[] = {{0, 0, 0}, {0.3f, 0.2f, 0.4f}, {0.5f, 0.5f, 0.5f}, {0.8f, 0.1f, 0.7f}};

TEST(FieldLeak, leakingBaselineLeaks) {
    EXPECT_GT(measureRooms(LeakGuard::none, 0.10f, kShifts[1]), 0.05);
}

TEST(FieldLeak, momentsKeepASealedRoomDark) {
    for (const glm::vec3 shift : kShifts) EXPECT_LT(measureRooms(LeakGuard::moments, 0.10f, shift), 0.004) << shift.x;
}

// Walls of a fiftieth and a twentieth of the spacing. The mean over several shifts, since one alone says little.
TEST(FieldLeak, thinWallsHoldToo) {
    for (const auto& [thickness, bound] : {std::pair(0.02f, 0.01), std::pair(0.05f, 0.006)}) {
        double share = 0;
        for (const glm::vec3 shift : kShifts)
            share += measureRooms(LeakGuard::moments, thickness, shift) / std::size(kShifts);
        EXPECT_LT(share, bound) << thickness;
        RecordProperty("share" + std::to_string(thickness), std::to_string(share));
    }
}

}  // namespace
}  // namespace probegi
