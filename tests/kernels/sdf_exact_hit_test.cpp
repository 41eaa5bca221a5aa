// Hits of a few theSolids. tests/tracer compares the tracers with each other and with meshes.
#include <gtest/gtest.h>

#include <vector>

#include "kernels/sdf_access.h"
#include "kernels/sdf_solids.h"

#include "kernels/sdf/exact_hit.h"

namespace probegi::kernels {
namespace {

// Cubes of 1 m along x, from these coordinates on.
void placeCubes(std::initializer_list<float> begins) {
    theSolids.clear();
    for (const float begin : begins) {
        theSolids.push_back(plainSolid(kSdfBox, vec3(0.5f)));
        theSolids.back().centre.x = begin + 0.5f;
    }
}

struct Shot {
    float distance;
    int solid;
    bool within, blocked;
};

Shot shoot(float from, float far = 1e30f, float near = 0) {
    Shot shot;
    const vec3 origin(from, 0, 0), direction(1, 0, 0);
    const SdfFound found = sdfClosestHit(origin, near, direction, far, int(theSolids.size()), shot.within);
    shot.distance = found.distance;
    shot.solid = found.solid;
    shot.blocked = sdfIsBlocked(origin, near, direction, far, int(theSolids.size()));
    return shot;
}

TEST(SdfExactHit, fromOutsideTheFirstEntry) {
    placeCubes({5, 2, 8});
    EXPECT_EQ(shoot(0).solid, 1);
    EXPECT_EQ(shoot(0).distance, 2);
    EXPECT_FALSE(shoot(0).within);
    EXPECT_TRUE(shoot(0).blocked);
    EXPECT_EQ(shoot(0, 1.9f).solid, -1);
    EXPECT_FALSE(shoot(0, 1.9f).blocked);
    EXPECT_TRUE(shoot(0, 2).blocked) << "near and far are included";
    EXPECT_TRUE(shoot(0, 3, 2).blocked);
    EXPECT_EQ(shoot(0, 2).solid, 1);
    EXPECT_EQ(shoot(0, 3, 2).distance, 2);
    EXPECT_EQ(shoot(3.5f).solid, 0);
    EXPECT_EQ(shoot(0, 1e30f, 3.5f).distance, 5);
    EXPECT_EQ(shoot(10).solid, -1);
    EXPECT_FALSE(shoot(10).blocked);
}

TEST(SdfExactHit, fromInsideTheWayOut) {
    placeCubes({5, 4, 3.5f, 7});
    const Shot shot = shoot(4);
    EXPECT_EQ(shot.solid, 0);
    EXPECT_EQ(shot.distance, 2);
    EXPECT_TRUE(shot.within && shot.blocked);
    EXPECT_EQ(shoot(4.2f, 1).solid, -1);
    EXPECT_TRUE(shoot(4.2f, 1).blocked) << "it enters another on its way";
    EXPECT_FALSE(shoot(5.2f, 0.5f).blocked);
    EXPECT_EQ(shoot(7.5f).distance, 0.5f);
}

TEST(SdfExactHit, solidGroundHasNoWayOut) {
    theSolids = {plainSolid(kSdfPlane, vec3(1.0f))};
    bool within = false;
    EXPECT_EQ(sdfClosestHit({0, -1, 0}, 0, {0.6f, -0.8f, 0}, 1e30f, 1, within).solid, -1);
    EXPECT_FALSE(sdfIsBlocked({0, -1, 0}, 0, {0.6f, -0.8f, 0}, 1e30f, 1));
    EXPECT_FLOAT_EQ(sdfClosestHit({0, -1, 0}, 0, {0, 1, 0}, 1e30f, 1, within).distance, 1);
    EXPECT_TRUE(within);
    EXPECT_EQ(sdfWayOut({0, 1, 0}, 0, {0, 1, 0}, 1).solid, -1) << "begins outside";
}

TEST(SdfExactHit, invalidRaysHitNothing) {
    placeCubes({1});
    bool within = false;
    const float nan = uintBitsToFloat(0x7fc00000u);
    EXPECT_EQ(sdfClosestHit({nan, 0, 0}, 0, {1, 0, 0}, 9, 1, within).solid, -1);
    EXPECT_EQ(sdfClosestHit({0, 0, 0}, 3, {1, 0, 0}, 2, 1, within).solid, -1);
    EXPECT_FALSE(sdfIsBlocked({0, 0, 0}, 0, {0, 0, 0}, 9, 1));
}

}  // namespace
}  // namespace probegi::kernels
