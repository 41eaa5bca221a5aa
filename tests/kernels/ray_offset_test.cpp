#include "kernels/trace/ray_offset.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

constexpr float kUnit = 1.1920929e-7f;  // unit in the last place, at 1

TEST(RayOffset, isSomeUnitsOfTheLargestCoordinate) {
    for (const vec3 p : {vec3(20, 1, -3), vec3(1, -20, 3), vec3(0, 0, 20)})
        EXPECT_FLOAT_EQ(rayOffset(p, 0), 32 * kUnit * 20);
    EXPECT_NEAR(rayOffset({20, 0, 0}, 0), 76e-6, 1e-6);
    // Near the origin of a large scene, an eighth of its extent counts.
    EXPECT_FLOAT_EQ(rayOffset({0.1f, 0, 0}, 80), 32 * kUnit * 10);
    EXPECT_FLOAT_EQ(rayOffset({50, 0, 0}, 80), 32 * kUnit * 50);
}

TEST(RayOffset, movesTheOriginAlongTheNormal) {
    const vec3 p(64, 2, 3);
    const vec3 moved = offsetOrigin(p, {0, 0, -1}, 100);
    EXPECT_EQ(moved.x, p.x);
    EXPECT_EQ(moved.y, p.y);
    EXPECT_FLOAT_EQ(moved.z, 3 - 32 * kUnit * 64);
}

// Slightly shorter than the distance to the light, but long enough to hit any wall before it.
TEST(RayOffset, shadowRaysEndALittleBeforeTheLight) {
    for (const float distance : {1e-3f, 1.0f, 1e6f}) {
        EXPECT_NEAR(shadowRayEnd(distance) / distance, 0.9999, 1e-6);
        EXPECT_LT(shadowRayEnd(distance), distance);
    }
}

}  // namespace
}  // namespace probegi::kernels
