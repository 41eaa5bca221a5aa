#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "analytic/field_scene.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

struct RoomLight {
    double dark = 0;  ///< mean E over the surfaces of the sealed room
    double lit = 0;   ///< the same of the sunlit room
};

double meanIrradiance(const Field& field, const std::vector<FieldQuery>& queries) {
    double sum = 0;
    for (const FieldQuery& q : queries) {
        const glm::vec3 e = field.irradiance(q);
        sum += (double(e.x) + e.y + e.z) / 3;
    }
    return sum / double(queries.size());
}

// Points on the inner faces of the room between x0 and x1 of dark-room, seen from the room's middle.
std::vector<FieldQuery> innerFaces(float x0, float x1) {
    std::vector<FieldQuery> queries;
    const glm::vec3 lower(x0, 0, -2.5f), upper(x1, 2.8f, 2.5f), centre = 0.5f * (lower + upper);
    for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true})
            for (int i = 1; i < 12; ++i)
                for (int j = 1; j < 12; ++j) {
                    glm::vec3 p = lower + (upper - lower) * glm::vec3(float(i) / 12, float(i) / 12, float(j) / 12);
                    if (axis == 2) p.y = lower.y + (upper.y - lower.y) * float(j) / 12;
                    p[axis] = high ? upper[axis] : lower[axis];
                    glm::vec3 n(0);
                    n[axis] = high ? -1.0f : 1.0f;
                    queries.push_back({p, n, glm::normalize(centre - p)});
                }
    return queries;
}

// dark-room with probes a metre apart; `shift` moves the grid, since a leak depends on where probes and walls meet.
RoomLight measureRooms(LeakGuard guard, float wallThickness, glm::vec3 shift) {
    FieldSetup desc;
    desc.guard = guard;
    test::FieldScene s(*makeBuiltinScene("dark-room", {.wallThickness = wallThickness}),
                       {glm::vec3(-7, -1.2f, -4) + shift, glm::vec3(1), {15, 6, 9}}, desc);
    EXPECT_TRUE(s.field.converge(*s.tracer, s.lighting, 1e-6f, 32));
    const float half = 0.5f * wallThickness;
    return {meanIrradiance(s.field, innerFaces(half, half + 5)), meanIrradiance(s.field, innerFaces(-half - 5, -half))};
}

constexpr glm::vec3 kShifts[] = {{0, 0, 0}, {0.3f, 0.2f, 0.4f}, {0.5f, 0.5f, 0.5f}, {0.8f, 0.1f, 0.7f}};

TEST(FieldLeak, leakingBaselineLeaks) {
    const RoomLight r = measureRooms(LeakGuard::none, 0.10f, kShifts[1]);
    EXPECT_GT(r.dark, 0.05 * r.lit);
}

TEST(FieldLeak, momentsKeepASealedRoomDark) {
    for (const glm::vec3 shift : kShifts) {
        const RoomLight r = measureRooms(LeakGuard::moments, 0.10f, shift);
        EXPECT_GT(r.lit, 0.1);
        EXPECT_LT(r.dark, 0.004 * r.lit) << shift.x << ": " << r.dark << " / " << r.lit;
    }
}

// Walls of a fiftieth and a twentieth of the probes' distance: the mean over the shifts, since one alone says little.
TEST(FieldLeak, thinWallsHoldToo) {
    for (const auto& [thickness, bound] : {std::pair(0.02f, 0.01), std::pair(0.05f, 0.006)}) {
        double share = 0;
        for (const glm::vec3 shift : kShifts) {
            const RoomLight r = measureRooms(LeakGuard::moments, thickness, shift);
            share += r.dark / r.lit / std::size(kShifts);
        }
        EXPECT_LT(share, bound) << thickness;
    }
}

}  // namespace
}  // namespace probegi
