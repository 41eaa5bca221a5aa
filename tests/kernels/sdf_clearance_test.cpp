#include "kernels/sdf/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/sdf/ray_span.h"
#include "kernels/sdf_solids.h"

namespace probegi::kernels {
namespace {

// The largest of the distances from a box's three pairs of faces: what the closed form goes by.
float facesDistance(vec3 halfSize, vec3 p) {
    const vec3 beyond = sdfBeyondFaces(halfSize, p);
    return max(beyond.x, max(beyond.y, beyond.z));
}

template <class Distance>
float leastOverWay(const Distance& distance, vec3 from, vec3 way) {
    float least = kSdfFar;
    for (int i = 1; i <= 2000; ++i) {
        const float t = float(i) / 2000;
        least = min(least, distance(from + way * t) / t);
    }
    return least;
}

TEST(SdfClearance, aWallAside) {
    const vec3 halfSize(0.1f, 5, 5);
    // Half a metre beside it all the way: at the end the ball has that radius.
    EXPECT_FLOAT_EQ(sdfBoxClearance(halfSize, {0.6f, 0, 0}, {0, 2, 0}), 0.5f);
    // Along its face, from the face: what is left is how far the way leads from it.
    EXPECT_FLOAT_EQ(sdfBoxClearance(halfSize, {0.1f, 0, 0}, {0.3f, 2, 0}), 0.3f);
    // It ends in front of it.
    EXPECT_NEAR(sdfBoxClearance(halfSize, {1.1f, 0, 0}, {-0.75f, 0, 0}), 0.25f, 1e-6f);
    // Through it, and up to its face.
    EXPECT_LE(sdfBoxClearance(halfSize, {1.1f, 0, 0}, {-2, 0, 0}), 0.0f);
    EXPECT_LE(sdfBoxClearance(halfSize, {1.1f, 0, 0}, {-1, 0, 0}), 1e-6f);
}

// An edge at half way: a ball sees past it in full if twice the distance by which the way passes is its radius.
TEST(SdfClearance, anEdgeOnTheWay) {
    EXPECT_NEAR(sdfBoxClearance({0.001f, 1, 5}, {-1, 1.1f, 0}, {2, 0, 0}), 0.2f, 0.02f);
    // The nearer to the point, the smaller the ball.
    EXPECT_NEAR(sdfBoxClearance({0.001f, 1, 5}, {-0.2f, 1.1f, 0}, {2, 0, 0}), 2.0f / 3, 0.01f);
    EXPECT_NEAR(sdfBoxClearance({0.001f, 1, 5}, {-1.8f, 1.1f, 0}, {2, 0, 0}), 2 / 19.0f, 1e-3f);
}

TEST(SdfClearance, theClosedFormIsTheLeastOfDistanceOverWay) {
    SdfDice dice;
    int partial = 0;
    for (int i = 0; i < 3000; ++i) {
        const vec3 halfSize = dice.vector(0.05f, 1);
        const vec3 from = dice.vector(-2, 2), way = dice.vector(-3, 3);
        if (facesDistance(halfSize, from) <= 0.01f) continue;
        const float found = sdfBoxClearance(halfSize, from, way);
        const float sampled = leastOverWay([&](vec3 p) { return facesDistance(halfSize, p); }, from, way);
        partial += sampled > 0 && sampled < 0.5f ? 1 : 0;
        EXPECT_NEAR(max(found, 0.0f), max(sampled, 0.0f), 5e-3f + 0.02f * max(sampled, 0.0f)) << i;
    }
    EXPECT_GT(partial, 30);
}

TEST(SdfClearance, positiveOnlyWhereTheWayMeetsNothing) {
    SdfDice dice;
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const SdfSolid solid = plainSolid(kSdfBox, dice.vector(0.002f, 1));
        const vec3 from = dice.vector(-2, 2), way = dice.vector(-3, 3);
        if (sdfLocalDistance(solid, from) <= 0) continue;
        const SdfSpan span = sdfRaySpan(solid, from, normalize(way));
        const bool blocked = span.entry <= span.exit && span.entry >= 0 && span.entry <= length(way);
        const float margin = min(abs(span.entry - span.exit), abs(span.entry - length(way)));
        if (margin < 1e-4f) continue;
        met += blocked ? 1 : 0;
        ASSERT_EQ(sdfClearance(solid, from, way) > 0, !blocked) << i;
    }
    EXPECT_GT(met, 800);
}

TEST(SdfClearance, otherShapesAreSearched) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        if (shape == kSdfBox) continue;
        int clear = 0, met = 0;
        for (int i = 0; i < 400; ++i) {
            SdfSolid solid = plainSolid(shape, dice.vector(0.1f, 1));
            solid.rounding = 0.05f;
            const vec3 from = dice.vector(-2, 2), way = dice.vector(-3, 3);
            if (sdfLocalDistance(solid, from) <= 0.02f) continue;
            const float found = sdfClearance(solid, from, way);
            const float sampled = leastOverWay([&](vec3 p) { return sdfLocalDistance(solid, p); }, from, way);
            EXPECT_NEAR(max(found, 0.0f), max(sampled, 0.0f), 5e-3f) << shape << ' ' << i;
            (sampled > 0 ? clear : met) += 1;
        }
        EXPECT_GT(clear, 50) << shape;
        EXPECT_GT(met, 10) << shape;
    }
}

TEST(SdfClearance, nearBoxes) {
    SdfBlocker blocker{plainSolid(kSdfBox, {1, 2, 3}), {1, 2, 3}};
    blocker.solid.centre = {10, 0, 0};
    EXPECT_TRUE(sdfIsNear(blocker, {8.5f, 0, 0}, {0.6f, 0, 0}));
    EXPECT_FALSE(sdfIsNear(blocker, {8.5f, 0, 0}, {0.4f, 9, 9}));
    EXPECT_FALSE(sdfIsNear(blocker, {10, 2.5f, 0}, {9, 0.4f, 9}));
    blocker.reach = vec3(kSdfFar);
    EXPECT_TRUE(sdfIsNear(blocker, {1e6f, 0, 0}, vec3(0.0f)));
}

}  // namespace
}  // namespace probegi::kernels
