#include "kernels/trace/triangle_hit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi::kernels {
namespace {

// The right triangle (0, 0) (2, 0) (0, 4) in the plane z = 5, with axes rotated so that z becomes `axis`.
struct Turned {
    int axis;

    vec3 operator()(vec3 v) const { return axis == 2 ? v : (axis == 0 ? vec3(v.z, v.x, v.y) : vec3(v.y, v.z, v.x)); }
    bool hits(vec3 origin, vec3 direction, float near, float far, TriangleHit& hit) const {
        return intersectTriangle(makeBvhRay((*this)(origin), (*this)(direction)), (*this)({0, 0, 5}),
                                 (*this)({2, 0, 5}), (*this)({0, 4, 5}), near, far, hit);
    }
    bool hits(vec3 origin, vec3 direction) const {
        TriangleHit hit;
        return hits(origin, direction, 0, 1e30f, hit);
    }
};

TEST(TriangleHit, distanceAndWeightsFromBothSides) {
    for (int axis = 0; axis < 3; ++axis) {
        const Turned turned{axis};
        TriangleHit hit;
        ASSERT_TRUE(turned.hits({0.5f, 2, 1}, {0, 0, 1}, 0, 1e30f, hit));
        EXPECT_NEAR(hit.distance, 4, 1e-6);
        EXPECT_NEAR(hit.barycentric.x, 0.25, 1e-6);
        EXPECT_NEAR(hit.barycentric.y, 0.5, 1e-6);
        // Oblique, from the other side, and with a direction that is not a unit vector, which scales the distance.
        ASSERT_TRUE(turned.hits({0.5f + 1, 1 - 2, 5 + 4}, {-0.5f, 1, -2}, 0, 1e30f, hit));
        EXPECT_NEAR(hit.distance, 2, 1e-6);
        EXPECT_NEAR(hit.barycentric.x, 0.25, 1e-6);
        EXPECT_NEAR(hit.barycentric.y, 0.25, 1e-6);
    }
}

TEST(TriangleHit, edgesAndCornersAreInside) {
    const Turned plain{2};
    for (const vec2 at : {vec2(0, 0), vec2(2, 0), vec2(0, 4), vec2(1, 2), vec2(1, 0), vec2(0, 2)})
        EXPECT_TRUE(plain.hits({at.x, at.y, 0}, {0, 0, 1})) << at.x << ' ' << at.y;
    for (const vec2 at : {vec2(-0.01f, 1), vec2(1, -0.01f), vec2(1.01f, 2), vec2(3, 3), vec2(-1, -1)}) {
        EXPECT_FALSE(plain.hits({at.x, at.y, 0}, {0, 0, 1})) << at.x << ' ' << at.y;
        EXPECT_FALSE(plain.hits({at.x, at.y, 9}, {0, 0, -1})) << at.x << ' ' << at.y;
    }
}

TEST(TriangleHit, nearAndFarAreIncluded) {
    const Turned plain{2};
    TriangleHit hit{-7, {-7, -7}};
    EXPECT_TRUE(plain.hits({0.5f, 1, 1}, {0, 0, 1}, 4, 4, hit));
    hit.distance = -7;
    EXPECT_FALSE(plain.hits({0.5f, 1, 1}, {0, 0, 1}, 4.001f, 9, hit));
    EXPECT_FALSE(plain.hits({0.5f, 1, 1}, {0, 0, 1}, 0, 3.999f, hit));
    EXPECT_FALSE(plain.hits({0.5f, 1, 1}, {0, 0, -1}, 0, 9, hit)) << "behind";
    EXPECT_EQ(hit.distance, -7) << "set only by a hit";
}

TEST(TriangleHit, degenerateTrianglesAndRaysInTheirPlaneMiss) {
    const BvhRay along = makeBvhRay({-1, 1, 5}, {1, 0, 0}), down = makeBvhRay({1, 0, 0}, {0, 0, 1});
    TriangleHit hit;
    EXPECT_FALSE(intersectTriangle(along, {0, 0, 5}, {2, 0, 5}, {0, 4, 5}, 0, 1e30f, hit));
    EXPECT_FALSE(intersectTriangle(down, {0, 0, 5}, {1, 0, 5}, {2, 0, 5}, 0, 1e30f, hit));
    EXPECT_FALSE(intersectTriangle(down, {1, 0, 5}, {1, 0, 5}, {1, 0, 5}, 0, 1e30f, hit));
}

// Section 3.1: in sheared space the ray is the z axis.
TEST(TriangleHit, shearTakesTheRayToTheAxis) {
    const vec3 direction(0.25f, -0.5f, 2);
    const BvhRay ray = makeBvhRay(vec3(0.0f), direction);
    for (const float t : {-1.0f, 0.5f, 8.0f}) EXPECT_EQ(shearedCorner(direction * t, ray), vec2(0.0f));
    EXPECT_EQ(shearedCorner(direction + vec3(3, 5, 0), ray), vec2(3, 5));
}

TEST(TriangleHit, edgeFunctionIsTwiceTheArea) {
    EXPECT_EQ(edgeFunction({1, 2}, {3, 4}), -2);
    EXPECT_EQ(edgeFunction({3, 4}, {1, 2}), 2);
    EXPECT_EQ(edgeFunction({2, 0}, {0, 3}), 6);
}

}  // namespace
}  // namespace probegi::kernels
