#include "kernels/sdf/way_out.h"

#include <gtest/gtest.h>

#include "kernels/sdf_solids.h"

namespace probegi::kernels {
namespace {

TEST(SdfWayOut, toTheNearestFace) {
    const vec3 halfSize(1, 2, 3);
    const vec3 up(0, 1, 0);
    EXPECT_LT(length(sdfBoxWayOut(halfSize, {0.9f, 0, 0}, up, 0.02f) - vec3(0.12f, 0, 0)), 1e-6f);
    EXPECT_LT(length(sdfBoxWayOut(halfSize, {-0.9f, 0, 0}, up, 0.02f) - vec3(-0.12f, 0, 0)), 1e-6f);
    EXPECT_LT(length(sdfBoxWayOut(halfSize, {0.5f, 1.8f, 0}, up, 0.02f) - vec3(0, 0.22f, 0)), 1e-6f);
    EXPECT_LT(length(sdfBoxWayOut(halfSize, {0.5f, 0, -2.75f}, up, 0.02f) - vec3(0, 0, -0.27f)), 1e-6f);
}

// A wall is left on the side to which the surface faces, however near its other side is.
TEST(SdfWayOut, notThroughTheWall) {
    const vec3 halfSize(0.1f, 2, 3);
    EXPECT_LT(length(sdfBoxWayOut(halfSize, {-0.09f, 0, 0}, {1, 0, 0}, 0.02f) - vec3(0.21f, 0, 0)), 1e-6f);
    EXPECT_LT(length(sdfBoxWayOut(halfSize, {-0.09f, 0, 0}, {-1, 0, 0}, 0.02f) - vec3(-0.03f, 0, 0)), 1e-6f);
}

TEST(SdfWayOut, nothingMovesOutside) {
    const vec3 halfSize(1, 2, 3);
    for (const vec3 p : {vec3(1.01f, 0, 0), vec3(0, -2.5f, 0), vec3(5, 5, 5), vec3(0, 0, 3)})
        EXPECT_EQ(sdfBoxWayOut(halfSize, p, {1, 0, 0}, 0.02f), vec3(0.0f));
}

TEST(SdfWayOut, oneOfTwoFacesThatAreAsNear) {
    const vec3 way = sdfBoxWayOut({1, 1, 1}, {0.75f, 0.75f, -0.75f}, {0, 1, 0}, 0.25f);
    EXPECT_EQ(way, vec3(0.5f, 0, 0));
    EXPECT_EQ(axisWayOut(1, 0.25f, 1), 0.75f);
    EXPECT_EQ(axisWayOut(1, 0.25f, -1), -1.25f);
    EXPECT_EQ(axisWayOut(1, -0.25f, 0), -0.75f);
}

TEST(SdfWayOut, throughWhatIsThinAndClose) {
    const vec3 curtain(0.01f, 2, 2);
    EXPECT_NEAR(sdfBoxThrough(curtain, {-0.08f, 0, 0}, {1, 0, 0}, 0.15f), 0.09f, 1e-6f);
    EXPECT_NEAR(sdfBoxThrough(curtain, {0.08f, 0.5f, 1}, {-0.8f, 0.6f, 0}, 0.15f), 0.09f / 0.8f, 1e-6f);
    EXPECT_EQ(sdfBoxThrough(curtain, {-0.08f, 0, 0}, {-1, 0, 0}, 0.15f), 0) << "it is behind the surface";
    EXPECT_EQ(sdfBoxThrough(curtain, {-0.2f, 0, 0}, {1, 0, 0}, 0.15f), 0) << "it is far";
    EXPECT_EQ(sdfBoxThrough(curtain, {-0.005f, 0, 0}, {1, 0, 0}, 0.15f), 0) << "the point is inside";
    EXPECT_EQ(sdfBoxThrough(curtain, {-0.08f, 3, 0}, {1, 0, 0}, 0.15f), 0) << "it is beside the point";
    EXPECT_EQ(sdfBoxThrough({1, 2, 2}, {-1.08f, 0, 0}, {1, 0, 0}, 0.15f), 0) << "it is a wall";
    EXPECT_EQ(sdfBoxThrough({0.05f, 2, 2}, {-0.15f, 0, 0}, {1, 0, 0}, 0.15f), 0) << "gap and wall together";
    const vec3 way = sdfWayOutOf(plainSolid(kSdfBox, curtain), {-0.08f, 0, 0}, {1, 0, 0}, 0.02f, 0.15f);
    EXPECT_LT(length(way - vec3(0.11f, 0, 0)), 1e-6f);
}

// Scenes may be in any unit: where all lengths are so many times as large, ways are too.
TEST(SdfWayOut, growWithTheScene) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        int moved = 0;
        for (int i = 0; i < 500; ++i) {
            SdfSolid solid = plainSolid(shape, dice.vector(0.3f, 1));
            solid.rounding = 0.1f;
            const vec3 p = dice.vector(-1, 1), normal = dice.direction();
            const vec3 way = sdfWayOutOf(solid, p, normal, 0.02f, 0.06f);
            if (way == vec3(0.0f)) continue;
            ++moved;
            for (const float scale : {1.0f / 1024, 1.0f / 128, 128.0f}) {
                SdfSolid other = solid;
                other.halfSize = solid.halfSize * scale;
                other.rounding = solid.rounding * scale;
                const vec3 scaled = sdfWayOutOf(other, p * scale, normal, 0.02f * scale, 0.06f * scale);
                EXPECT_LT(length(scaled / scale - way), 1e-4f * length(way)) << shape << ' ' << i << ' ' << scale;
            }
        }
        EXPECT_GT(moved, 20) << shape;
    }
}

TEST(SdfWayOut, ofAllShapes) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        int moved = 0;
        for (int i = 0; i < 500; ++i) {
            SdfSolid solid = plainSolid(shape, dice.vector(0.3f, 1));
            solid.rounding = 0.1f;
            const vec3 p = dice.vector(-1, 1), normal = dice.direction();
            const vec3 way = sdfWayOutOf(solid, p, normal, 0.02f, 0);
            const float before = sdfLocalDistance(solid, p), after = sdfLocalDistance(solid, p + way);
            if (before > 0) {
                EXPECT_EQ(way, vec3(0.0f));
            } else if (way != vec3(0.0f)) {
                ++moved;
                EXPECT_GT(dot(normalize(way), normal), kOtherSide - 0.01f);
                // Exact but near edges and axes, where the gradient is that of a step away.
                EXPECT_GT(after, shape == kSdfBox ? 0.019f : -0.05f) << shape;
            } else {
                EXPECT_NE(shape, kSdfBox);
            }
        }
        EXPECT_GT(moved, 20) << shape;
    }
}

}  // namespace
}  // namespace probegi::kernels
