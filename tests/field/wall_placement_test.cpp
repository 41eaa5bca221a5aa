#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "field/walls.h"
#include "probegi/field.h"
#include "support/analytic_tracer.h"

namespace probegi {
namespace {

// A box of six quads, turned; with `inward`, the fronts are inside.
void addBox(test::AnalyticTracer& world, glm::vec3 lower, glm::vec3 upper, bool inward, const glm::quat& turn) {
    for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) {
            glm::vec3 corner = lower, u(0), v(0);
            if (high) corner[axis] = upper[axis];
            u[(axis + 1) % 3] = upper[(axis + 1) % 3] - lower[(axis + 1) % 3];
            v[(axis + 2) % 3] = upper[(axis + 2) % 3] - lower[(axis + 2) % 3];
            if (high == inward) std::swap(u, v);
            world.addQuad(turn * corner, turn * u, turn * v, 0);
        }
}

// About the vertical.
void addBox(test::AnalyticTracer& world, glm::vec3 lower, glm::vec3 upper, bool inward, float degrees = 0) {
    addBox(world, lower, upper, inward, glm::angleAxis(glm::radians(degrees), glm::vec3(0, 1, 0)));
}

// A room with walls of the given thickness.
test::AnalyticTracer room(glm::vec3 lower, glm::vec3 upper, float thickness, float degrees = 0) {
    test::AnalyticTracer world;
    world.materials.resize(1);
    addBox(world, lower, upper, true, degrees);
    addBox(world, lower - thickness, upper + thickness, false, degrees);
    return world;
}

// Cells from a surface to the first layer of probes in front of it.
float cellsInFront(const VolumeDesc& grid, int axis, float place, bool up) {
    const float x = (place - grid.origin[axis]) / grid.spacing[axis];
    return up ? std::ceil(x) - x : x - std::floor(x);
}

void expectMargin(const VolumeDesc& grid, const Bounds& bounds, float cells) {
    const glm::vec3 last = grid.origin + grid.spacing * glm::vec3(grid.counts - 1);
    for (int a = 0; a < 3; ++a) {
        EXPECT_LE(grid.origin[a], bounds.lower[a] - 0.999f * cells * grid.spacing[a]);
        EXPECT_GE(last[a], bounds.upper[a] + 0.999f * cells * grid.spacing[a]);
    }
}

const glm::vec3 kLower(1.3f, -0.4f, -7.1f), kUpper(7.5f, 2.5f, -2.2f);

// Mean difference from a fifth of a cell over the room's six sides.
float cellsOff(const VolumeDesc& grid) {
    float sum = 0;
    for (int axis = 0; axis < 3; ++axis)
        sum += std::abs(cellsInFront(grid, axis, kLower[axis], true) - 0.2f) +
               std::abs(cellsInFront(grid, axis, kUpper[axis], false) - 0.2f);
    return sum / 6;
}

TEST(WallPlacement, theFirstProbesStandAFifthOfACellInsideARoom) {
    for (const float thickness : {0.05f, 0.2f, 0.7f})
        for (const auto& [target, bound] : {std::pair(500, 0.30f), std::pair(2000, 0.17f), std::pair(8192, 0.08f)}) {
            const test::AnalyticTracer world = room(kLower, kUpper, thickness);
            const auto grid = placeVolume(world, {.targetProbes = target});
            ASSERT_TRUE(grid) << grid.error().message;
            EXPECT_LT(cellsOff(*grid), bound) << thickness << ' ' << target;
            EXPECT_LE(cellsOff(*grid), cellsOff(*placeVolume(world.bounds(), {.targetProbes = target})));
            EXPECT_LE(probeCount(*grid), target);
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_LT(std::abs(grid->spacing[axis] / grid->spacing[0] - 1), 0.21f) << "near-cubic cells";
            expectMargin(*grid, world.bounds(), 1);
        }
}

TEST(WallPlacement, countsAndMarginAreKept) {
    const test::AnalyticTracer world = room(kLower, kUpper, 0.2f);
    for (const float margin : {0.0f, 1.0f, 2.0f}) {
        const auto grid = placeVolume(world, {.counts = {12, 9, 11}, .marginCells = margin});
        ASSERT_TRUE(grid);
        EXPECT_EQ(grid->counts, glm::ivec3(12, 9, 11));
        expectMargin(*grid, world.bounds(), margin);
    }
    // Too few probes for a margin, which leaves no choice.
    const auto tiny = placeVolume(world, {.counts = {2, 2, 2}});
    const auto byBounds = placeVolume(world.bounds(), {.counts = {2, 2, 2}});
    ASSERT_TRUE(tiny && byBounds);
    EXPECT_EQ(tiny->origin, byBounds->origin);
}

TEST(WallPlacement, whatIsNotSeenDoesNotCount) {
    // The outer faces have more area than the inner ones, but their fronts are not visible from the room or the walls.
    const test::AnalyticTracer world = room(kLower, kUpper, 0.7f);
    const std::vector<WallSample> samples = *findWalls(world);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 along(0);
        along[axis] = 1;
        const std::vector<WallPoint> across = wallsAcross(samples, along);
        EXPECT_GT(across.size(), 500u);
        for (const WallPoint& wall : across) EXPECT_NEAR(wall.place, wall.up ? kLower[axis] : kUpper[axis], 1e-4f);
        // In a convex room, points are seen in proportion to area times mean visible distance: all of them, and by
        // symmetry equally often up and down an axis.
        const auto up = std::count_if(across.begin(), across.end(), [](const WallPoint& w) { return w.up; });
        EXPECT_NEAR(double(up) / double(across.size()), 0.5, 0.05);
    }
}

TEST(WallPlacement, floorsCountWhereThereAreNoWalls) {
    test::AnalyticTracer world;
    world.materials.resize(1);
    world.addQuad({-20, 0.35f, -20}, {0, 0, 40}, {40, 0, 0}, 0);  // faces up
    world.addSphere({0, 4, 0}, 1.5f, false, 0);
    const auto grid = placeVolume(world), byBounds = placeVolume(world.bounds());
    ASSERT_TRUE(grid && byBounds);
    EXPECT_NEAR(cellsInFront(*grid, 1, 0.35f, true), 0.2f, 0.05f);
    expectMargin(*grid, world.bounds(), 1);
    for (const int axis : {0, 2}) {
        EXPECT_EQ(grid->origin[axis], byBounds->origin[axis]);
        EXPECT_EQ(grid->spacing[axis], byBounds->spacing[axis]);
    }
}

TEST(WallPlacement, aTurnedRoomOfAGridThatMustNotTurnIsPlacedByFloorAndCeilingOnly) {
    const test::AnalyticTracer world = room(kLower, kUpper, 0.2f, 30);
    const auto grid = placeVolume(world, {.turned = false}), byBounds = placeVolume(world.bounds());
    ASSERT_TRUE(grid && byBounds);
    for (const int axis : {0, 2}) EXPECT_EQ(grid->origin[axis], byBounds->origin[axis]);
    EXPECT_NEAR(cellsInFront(*grid, 1, kLower.y, true), 0.2f, 0.15f);
    EXPECT_NEAR(cellsInFront(*grid, 1, kUpper.y, false), 0.2f, 0.15f);
}

// Turned about any axis, a room has the grid that it has when it stands straight, turned with it.
TEST(WallPlacement, theGridTurnsWithARoom) {
    const test::AnalyticTracer straight = room(kLower, kUpper, 0.2f);
    const VolumeDesc upright = *placeVolume(straight);
    EXPECT_EQ(upright.orientation, VolumeDesc{}.orientation);
    for (const glm::vec3 axis : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::normalize(glm::vec3(1, 2, -0.5f))})
        for (const float degrees : {12.0f, 30.0f, 44.0f}) {
            const glm::quat turn = glm::angleAxis(glm::radians(degrees), axis);
            test::AnalyticTracer world;
            world.materials.resize(1);
            addBox(world, kLower, kUpper, true, turn);
            addBox(world, kLower - 0.2f, kUpper + 0.2f, false, turn);
            const auto grid = placeVolume(world);
            ASSERT_TRUE(grid) << grid.error().message;
            EXPECT_GT(std::abs(glm::dot(grid->orientation, turn)), 0.99999f) << degrees;
            EXPECT_EQ(grid->counts, upright.counts);
            VolumeDesc back = *grid;  // as it stands to the room
            back.origin = glm::conjugate(turn) * back.origin;
            EXPECT_LT(cellsOff(back), 0.1f) << degrees;
            expectMargin(back, straight.bounds(), 0.98f);
            EXPECT_NEAR(back.spacing.x / upright.spacing.x, 1, 0.05f);
        }
}

// A room that stands obliquely in a hall of the world's axes, and things without any direction, turn nothing.
TEST(WallPlacement, theGridStandsStraightWhereMostDoes) {
    test::AnalyticTracer hall, balls;
    hall.materials.resize(1), balls.materials.resize(1);
    addBox(hall, {-9, 0, -9}, {9, 5, 9}, true);
    addBox(hall, {-9.2f, -0.2f, -9.2f}, {9.2f, 5.2f, 9.2f}, false);
    addBox(hall, {1, 0.01f, 1}, {3, 2, 4}, false, 30);
    for (int i = 0; i < 9; ++i) balls.addSphere({2 * (i % 3), i / 3, -i}, 0.8f, false, 0);
    for (const test::AnalyticTracer* world : {&hall, &balls})
        EXPECT_EQ(placeVolume(*world)->orientation, VolumeDesc{}.orientation);
}

TEST(WallPlacement, aLoneObjectAndAVoidKeepTheGridOfTheirBounds) {
    test::AnalyticTracer ball, inverted;
    ball.materials.resize(1), inverted.materials.resize(1);
    ball.addSphere({1, 2, 3}, 2, false, 0);
    addBox(inverted, kLower, kUpper, false);  // a solid, with no room inside
    for (const test::AnalyticTracer* world : {&ball, &inverted}) {
        const auto grid = placeVolume(*world), byBounds = placeVolume(world->bounds());
        ASSERT_TRUE(grid && byBounds);
        EXPECT_EQ(grid->origin, byBounds->origin);
        EXPECT_EQ(grid->spacing, byBounds->spacing);
    }
    EXPECT_FALSE(placeVolume(test::AnalyticTracer()));  // no extent
}

// No placement suits the rooms on both sides of a wall: the error over all walls counts.
TEST(WallPlacement, severalRoomsShareTheBest) {
    const auto error = [](AxisPlacement p, const std::vector<WallPoint>& walls) {
        double sum = 0;
        for (const WallPoint& wall : walls) {
            const float x = (wall.place - p.first) / p.spacing;
            const float distance = wall.up ? std::ceil(x) - x : x - std::floor(x);
            sum += distance * p.spacing;
        }
        return sum / double(walls.size());
    };
    const std::vector<WallPoint> walls{{0.0f, true},  {3.1f, false}, {3.3f, true},
                                       {7.9f, false}, {8.3f, true},  {12, false}};
    for (const float spacing : {0.4f, 0.5f, 0.7f, 0.9f}) {
        const int count = int(12.4f / spacing + 2.5f) + 2;
        const AxisPlacement before{5.8f - 0.5f * float(count - 1) * spacing, spacing};
        const AxisPlacement after = fitToWalls(walls, walls.size(), before, count, -0.2f, 12.2f, 1);
        EXPECT_LE(error(after, walls), error(before, walls) + 1e-6) << spacing;
        EXPECT_EQ(after.first, fitToWalls(walls, walls.size(), before, count, -0.2f, 12.2f, 1).first);
    }
}

class BrokenTracer : public test::AnalyticTracer {
public:
    Result<void> closestHits(std::span<const Ray>, std::span<Hit>) const override {
        return Error{ErrorCode::deviceLost, "the GPU was lost"};
    }
};

TEST(WallPlacement, anErrorOfTheTracerIsPassedOn) {
    BrokenTracer world;
    world.addSphere({0, 0, 0}, 1, true, 0);
    const auto grid = placeVolume(world);
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::deviceLost);
}

}  // namespace
}  // namespace probegi
