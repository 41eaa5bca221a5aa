// The traversal by hand, in a world of two nodes. tests/bvh tests it on real trees, against brute force.
#include <gtest/gtest.h>

#include <vector>

#include "kernels/trace/bvh_scene.h"

namespace probegi::kernels {
namespace {

struct World {
    std::vector<BvhNode> nodes;
    std::vector<BvhTriangle> triangles;
    std::vector<BvhInstance> instances;
    bool solid = true;  // whether rays hit masked triangles
};
World world;

BvhNode bvhNode(uint index) {
    return world.nodes[index];
}
BvhTriangle bvhTriangle(uint index) {
    return world.triangles[index];
}
BvhInstance bvhInstance(uint index) {
    return world.instances[index];
}
bool bvhAlphaPasses(int, int, vec2) {
    return world.solid;
}

}  // namespace
}  // namespace probegi::kernels

#include "kernels/trace/bvh_traverse.h"

namespace probegi::kernels {
namespace {

// A node whose only child, a leaf in slot 0, covers -127..128 m.
BvhNode leafNode(uint first, uint count) {
    BvhNode n{};
    n.origin = vec3(-127);
    n.exponents = 127u | 127u << 8u | 127u << 16u;
    n.leaves = first;
    n.meta.x = ((1u << count) - 1u) << 5;
    n.lowerX = n.lowerY = n.lowerZ = {0xffffff00u, 0xffffffffu};
    n.upperX = n.upperY = n.upperZ = {255u, 0u};
    return n;
}

// A triangle that the z axis hits at `z`, with barycentric weights of a third.
BvhTriangle across(float z, int primitive, int geometry = 0) {
    return {{-1, -1, z}, primitive, {2, -1, z}, geometry, {-1, 2, z}, 0};
}

// Root 0: triangles at z = 6, 4 (masked) and 8. Root 1: an instance of root 2, which has a triangle at z = 1, moved to
// z = 11 and turned so that its y is the world's x.
void makeWorld() {
    world.nodes = {leafNode(0, 3), leafNode(0, 1), leafNode(3, 1)};
    world.triangles = {across(6, 10), across(4, 11, 1), across(8, 12), across(1, 20)};
    world.instances = {{{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 10}, 2, 77, 0, 0}};
    world.solid = true;
}

BvhHit hit(uint worldRoot, uint instancesRoot, float near = 0, float far = 1e30f, vec3 direction = {0, 0, 1}) {
    return bvhClosestHit(vec3(0.0f), near, direction, far, worldRoot, instancesRoot);
}

TEST(BvhTraverse, findsTheClosestOfALeaf) {
    makeWorld();
    const BvhHit h = hit(0, kBvhNone);
    EXPECT_EQ(h.primitive, 11);
    EXPECT_EQ(h.geometry, 1);
    EXPECT_EQ(h.instance, -1);
    EXPECT_NEAR(h.distance, 4, 1e-6);
    EXPECT_NEAR(h.barycentric.x, 1.0f / 3, 1e-6);
    EXPECT_NEAR(h.barycentric.y, 1.0f / 3, 1e-6);
    world.solid = false;
    EXPECT_EQ(hit(0, kBvhNone).primitive, 10) << "through the hole";
    EXPECT_EQ(hit(0, kBvhNone, 7).primitive, 12);
}

TEST(BvhTraverse, findsWhatInstancesPlace) {
    makeWorld();
    for (const BvhHit& h : {hit(kBvhNone, 1), hit(0, 1, 9)}) {
        EXPECT_EQ(h.primitive, 20);
        EXPECT_EQ(h.geometry, 0);
        EXPECT_EQ(h.instance, 77);
        EXPECT_NEAR(h.distance, 11, 1e-5);
    }
    EXPECT_EQ(hit(0, 1).primitive, 11) << "the world's is closer";
    // Turned: x' = y and y' = -x of the world.
    EXPECT_EQ(bvhClosestHit({0.9f, 0.9f, 0}, 9, {0, 0, 1}, 99, 0, 1).primitive, 20);
    EXPECT_EQ(bvhClosestHit({-0.9f, 0.9f, 0}, 9, {0, 0, 1}, 99, 0, 1).primitive, -1);
}

TEST(BvhTraverse, raysThatHitNothingAreMisses) {
    makeWorld();
    for (const BvhHit& h : {hit(kBvhNone, kBvhNone), hit(0, 1, 0, 3), hit(0, 1, 12), hit(0, 1, 0, 99, {0, 0, -1}),
                            hit(0, 1, 2, 1), hit(0, 1, 0, 99, {0, 0, 0})}) {
        EXPECT_EQ(h.primitive, -1);
        EXPECT_EQ(h.geometry, -1);
        EXPECT_EQ(h.instance, -1);
        EXPECT_EQ(h.distance, kBvhMissDistance);
    }
}

TEST(BvhTraverse, occlusionIsAnyHit) {
    makeWorld();
    const auto occluded = [](float near, float far) { return bvhOccluded(vec3(0.0f), near, {0, 0, 1}, far, 0, 1); };
    EXPECT_TRUE(occluded(0, 5));
    EXPECT_TRUE(occluded(9, 12));
    EXPECT_FALSE(occluded(9, 10));
    EXPECT_FALSE(occluded(0, 3));
}

// Bits 24..31: remaining children, by slot ^ octant. Bits 0..7: slots with inner nodes, which are stored in this order.
TEST(BvhTraverse, childrenOfAGroupInOrder) {
    uvec2 group(100, 0xa0000000u | 0x96u);  // slots 1, 2, 4 and 7; those at bits 31 and 29 are hit
    EXPECT_EQ(bvhNextChild(group, 0), 103u) << "slot 7, the fourth";
    EXPECT_EQ(group.y, 0x20000000u | 0x96u);
    EXPECT_EQ(bvhNextChild(group, 1), 102u) << "bit 5, octant 1: slot 4, the third";
    EXPECT_EQ(group.y, 0x96u);
    EXPECT_EQ(bvhRootGroup(9), uvec2(9, 0x80000000u));
}

TEST(BvhScene, instancesTakeTheirOriginAwayFirst) {
    const BvhInstance placed{{1, 2, 3, 10}, {4, 5, 6, 20}, {7, 8, 9, 30}, 0, 0, 0, 0};
    EXPECT_EQ(bvhInstanceVector(placed, {1, 10, 100}), vec3(321, 654, 987));
    EXPECT_EQ(bvhInstancePoint(placed, {11, 30, 130}), vec3(321, 654, 987));
    EXPECT_GE(kBvhStackSize, kBvhTriangleLevels - 1 + kBvhInstanceLevels - 1 + 1);
}

}  // namespace
}  // namespace probegi::kernels
