#include "kernels/trace/bvh_node.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace probegi::kernels {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

TEST(BvhRay, rotationPutsAnAxisLast) {
    EXPECT_EQ(bvhRotate({1, 2, 3}, 0), vec3(2, 3, 1));
    EXPECT_EQ(bvhRotate({1, 2, 3}, 1), vec3(3, 1, 2));
    EXPECT_EQ(bvhRotate({1, 2, 3}, 2), vec3(1, 2, 3));
}

TEST(BvhRay, onlyFiniteRaysWithADirectionAndAnIntervalAreValid) {
    const vec3 o(1, 2, 3), d(0, -1, 0);
    EXPECT_TRUE(bvhRayIsValid(o, 0, d, kInfinity));
    EXPECT_TRUE(bvhRayIsValid(o, 2, d, 2));
    EXPECT_FALSE(bvhRayIsValid(o, 2, d, 1.9f));
    EXPECT_FALSE(bvhRayIsValid(o, 0, vec3(0.0f), 1));
    for (int axis = 0; axis < 3; ++axis) {
        vec3 along(0.0f);
        along[axis] = -1e-30f;
        EXPECT_TRUE(bvhRayIsValid(o, 0, along, 1)) << axis;
        for (const float bad : {kInfinity, -kInfinity, kNan}) {
            vec3 origin = o, direction = d;
            origin[axis] = direction[axis] = bad;
            EXPECT_FALSE(bvhRayIsValid(origin, 0, d, 1)) << axis;
            EXPECT_FALSE(bvhRayIsValid(o, 0, direction, 1)) << axis;
        }
    }
    EXPECT_FALSE(bvhRayIsValid(o, kNan, d, 1));
    EXPECT_FALSE(bvhRayIsValid(o, -kInfinity, d, 1));
    EXPECT_FALSE(bvhRayIsValid(o, 0, d, kNan));
}

TEST(BvhRay, inverseIsFinite) {
    EXPECT_EQ(bvhInverse(0.5f, 1), 2.0f);
    EXPECT_EQ(bvhInverse(-4, 4), -0.25f);
    EXPECT_FLOAT_EQ(bvhInverse(0, 1), 1e18f);
    EXPECT_FLOAT_EQ(bvhInverse(1e-20f, 1), 1e18f);
    EXPECT_FLOAT_EQ(bvhInverse(-1e-20f, 1), -1e18f);
    EXPECT_FLOAT_EQ(bvhInverse(0, 1e-6f), 1e24f);
    EXPECT_FLOAT_EQ(bvhInverse(1e-17f, 1), 1e17f);
}

TEST(BvhRay, knowsItsLargestAxisShearAndOctant) {
    const BvhRay ray = makeBvhRay({1, 2, 3}, {1, -4, 2});
    EXPECT_EQ(ray.origin, vec3(1, 2, 3));
    EXPECT_EQ(ray.inverse, vec3(1, -0.25f, 0.5f));
    EXPECT_EQ(ray.axis, 1);
    EXPECT_EQ(ray.shear, vec3(2.0f / -4, 1.0f / -4, 1.0f / -4));
    EXPECT_EQ(ray.octant, 5u);
    EXPECT_EQ(makeBvhRay(vec3(0.0f), {-8, 4, 2}).axis, 0);
    EXPECT_EQ(makeBvhRay(vec3(0.0f), {-8, 4, 2}).octant, 6u);
    EXPECT_EQ(makeBvhRay(vec3(0.0f), {1, 4, -8}).axis, 2);
    EXPECT_EQ(makeBvhRay(vec3(0.0f), {1, 4, -8}).octant, 3u);
    EXPECT_EQ(makeBvhRay(vec3(0.0f), {0, 0, 1}).octant, 7u) << "0 is not negative";
}

void setByte(uvec2& words, int slot, uint value) {
    words[slot / 4] |= value << (8 * (slot % 4));
}

// A node at (10, 20, 30) with steps of 1, 2 and 1/2 m, whose boxes have the quantised planes `lower` and `upper`.
struct Node {
    BvhNode node{};

    Node() {
        node.origin = {10, 20, 30};
        node.exponents = 127u | 128u << 8u | 126u << 16u;
        for (uvec2* lower : {&node.lowerX, &node.lowerY, &node.lowerZ}) *lower = uvec2(0xffffffffu);
    }
    void place(int slot, uint meta, std::array<uint, 3> lower, std::array<uint, 3> upper) {
        setByte(node.meta, slot, meta);
        uvec2* lowers[] = {&node.lowerX, &node.lowerY, &node.lowerZ};
        uvec2* uppers[] = {&node.upperX, &node.upperY, &node.upperZ};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            (*lowers[axis])[slot / 4] &= ~(255u << (8 * (slot % 4)));
            setByte(*lowers[axis], slot, lower[axis]);
            setByte(*uppers[axis], slot, upper[axis]);
        }
    }
    uint hits(vec3 origin, vec3 direction, float near = 0, float far = 1e30f) const {
        return bvhNodeHits(node, makeBvhRay(origin, direction), near, far);
    }
};

// Slot 0: a leaf of two triangles from the fourth on, 10..20 x 20..40 x 30..35.
constexpr uint kLeaf = 3u << 4;
Node oneLeaf() {
    Node n;
    n.place(0, 3u << 5 | 4u, {0, 0, 0}, {10, 10, 10});
    return n;
}

TEST(BvhNode, aBoxIsMetWhereItStands) {
    const Node n = oneLeaf();
    // Along each axis in both directions, through the middle; then beside the box by 1 % of its side.
    const vec3 lower(10, 20, 30), upper(20, 40, 35), middle(15, 30, 32.5f);
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            vec3 direction(0.0f), origin = middle;
            direction[axis] = sign;
            origin[axis] = middle[axis] - 100 * sign;
            const float half = 0.5f * (upper - lower)[axis];
            EXPECT_EQ(n.hits(origin, direction), kLeaf) << axis << sign;
            EXPECT_EQ(n.hits(origin, direction, 0, 100 - 1.01f * half), 0u) << axis << sign;
            EXPECT_EQ(n.hits(origin, direction, 0, 100 - 0.99f * half), kLeaf) << axis << sign;
            EXPECT_EQ(n.hits(origin, direction, 100 + 1.01f * half), 0u) << axis << sign;
            EXPECT_EQ(n.hits(origin, direction, 100 + 0.99f * half), kLeaf) << axis << sign;
            EXPECT_EQ(n.hits(origin, -direction), 0u) << axis << sign;
            for (int side = 1; side < 3; ++side) {
                const int other = (axis + side) % 3;
                vec3 beside = origin;
                beside[other] = upper[other] + 0.05f;
                EXPECT_EQ(n.hits(beside, direction), 0u) << axis << sign;
                beside[other] = lower[other] - 0.05f;
                EXPECT_EQ(n.hits(beside, direction), 0u) << axis << sign;
                beside[other] = lower[other] + 0.05f;
                EXPECT_EQ(n.hits(beside, direction), kLeaf) << axis << sign;
            }
        }
}

// Rays along a face or an edge must not miss the box by rounding: it is padded by a millionth of a distance's terms.
TEST(BvhNode, facesAndEdgesBelongToTheBox) {
    const Node n = oneLeaf();
    EXPECT_EQ(n.hits({-90, 40, 32}, {1, 0, 0}), kLeaf);
    EXPECT_EQ(n.hits({-90, 20, 35}, {1, 0, 0}), kLeaf);
    EXPECT_EQ(n.hits({0, 10, 32}, {1, 1, 0}), kLeaf) << "through the edge";
    EXPECT_EQ(n.hits({15, 30, -70}, {0, 0, 1}, 0, 99.9999f), kLeaf);
    EXPECT_EQ(n.hits({15, 30, -70}, {0, 0, 1}, 0, 99.99f), 0u);
}

// A child in slot s has bit 24 + (s ^ octant): the nearest along the ray has the highest bit.
TEST(BvhNode, innerNodesComeInTheOrderOfTheOctant) {
    Node n;
    for (int slot = 0; slot < 8; ++slot) {
        const uint x = slot & 1 ? 100 : 0, y = slot & 2 ? 100 : 0, z = slot & 4 ? 100 : 0;
        n.place(slot, kBvhInnerMeta + uint(slot), {x, y, z}, {x + 50, y + 50, z + 50});
    }
    EXPECT_EQ(n.hits({0, 0, 25}, {1, 2, 0.5f}), 1u << (24 + 7) | 1u << (24 + 0));
    for (uint slot = 0; slot < 8; ++slot) {
        // Straight into one child, from outside.
        const vec3 middle(slot & 1 ? 135 : 35, slot & 2 ? 270 : 70, slot & 4 ? 92.5f : 42.5f);
        const vec3 direction(slot & 1 ? -1 : 1, slot & 2 ? -1 : 1, slot & 4 ? -0.2f : 0.2f);
        const uint octant = (slot ^ 7u) & 7u;
        EXPECT_EQ(n.hits(middle - 30.0f * direction, direction, 0, 31), 1u << (24 + (slot ^ octant))) << slot;
    }
}

TEST(BvhNode, allEightSlotsAreLookedAt) {
    for (int slot = 0; slot < 8; ++slot) {
        Node n;
        n.place(slot, 7u << 5 | uint(3 * (slot % 7)), {0, 0, 0}, {10, 10, 10});
        EXPECT_EQ(n.hits({15, 30, 0}, {0, 0, 1}), 7u << (3 * (slot % 7))) << slot;
        EXPECT_EQ(n.hits({15, 30, 90}, {0, 0, -1}), 7u << (3 * (slot % 7))) << slot;
        EXPECT_EQ(n.hits({25, 30, 0}, {0, 0, 1}), 0u) << slot;
    }
}

}  // namespace
}  // namespace probegi::kernels
