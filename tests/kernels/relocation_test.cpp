#include "kernels/probe/relocation.h"

#include <gtest/gtest.h>

#include "kernels/trace/ray_set.h"

namespace probegi::kernels {
namespace {

constexpr int kRays = int(kRelocationRays);

// What a probe sees by the placing rays, of a scene that is a function of the direction: RayDatum::distance.
template <class Scene>
PlaceSight look(const Scene& scene, bool solid = true) {
    PlaceSight sight = nothingSeen();
    for (uint i = 0; i < kRelocationRays; ++i) {
        const vec3 direction = sphericalFibonacci(i, kRelocationRays);
        const float distance = scene(direction);
        addToPlaceSight(sight, direction, distance, solid && distance < 0);
    }
    return sight;
}

// Distance to a plane in front of the probe, which shows `side` (1: its front) there.
float toPlane(vec3 direction, vec3 towards, float distance, float side = 1.0f) {
    const float cosine = dot(direction, towards);
    return cosine > 1e-4f ? side * distance / cosine : 1e30f;
}

TEST(Relocation, aProbeInAWallMovesOutThroughItsNearestBack) {
    // A wall 0.4 thick, seen from within, 0.1 from its face in +x: probes may move by 0.45.
    const vec3 x(1, 0, 0);
    const auto wall = [&](vec3 d) {
        return std::max(toPlane(d, x, 0.1f, -1), toPlane(d, -x, 0.3f, -1)) < 1e29f
                   ? std::max(toPlane(d, x, 0.1f, -1), toPlane(d, -x, 0.3f, -1))
                   : std::min(toPlane(d, x, 0.1f, -1), toPlane(d, -x, 0.3f, -1));
    };
    for (const int rules : {kRulesMeasured, kRulesPaper}) {
        const PlaceSight sight = look(wall);
        ASSERT_TRUE(isInside(sight.seen, kRays, rules));
        const vec3 moved = relocated(vec3(0), sight, kRays, vec3(1), 1.0f, rules);
        EXPECT_GT(moved.x, 0.1f) << "out of the wall";
        EXPECT_LT(moved.x, 0.45f);
    }
}

TEST(Relocation, aBackBeyondTheLimitIsNotReached) {
    const vec3 toBack(0.5f, 0, 0);
    EXPECT_EQ(movedThroughBack(vec3(0.1f, 0, 0), toBack, vec3(0.45f)), vec3(0.1f, 0, 0));
    EXPECT_EQ(movedThroughBack(vec3(0), vec3(0), vec3(0.45f)), vec3(0)) << "on the back itself";
}

TEST(Relocation, theWayThroughABackIsAsLongAsTheLimitAllows) {
    const vec3 limit(0.45f);
    for (float way = 0.05f; way < 0.44f; way += 0.03f) {
        const vec3 moved = movedThroughBack(vec3(0), vec3(0, way, 0), limit);
        EXPECT_LT(moved.y, 0.45f);
        EXPECT_GE(moved.y, way);
        EXPECT_NEAR(moved.y, std::min(2 * way, 0.45f), 0.0101f * way + 1e-4f);
    }
}

TEST(Relocation, aProbeCloseToAWallMovesAwayFromIt) {
    // A narrow room: a wall 0.03 away in -y, the opposite one 3 away.
    const auto room = [](vec3 d) {
        float nearest = std::min(toPlane(d, {0, -1, 0}, 0.03f), toPlane(d, {0, 1, 0}, 3));
        for (const vec3 side : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 0, 1), vec3(0, 0, -1)})
            nearest = std::min(nearest, toPlane(d, side, 1));
        return nearest;
    };
    const PlaceSight sight = look(room);
    const vec3 measured = relocated(vec3(0), sight, kRays, vec3(1), 1.0f, kRulesMeasured);
    EXPECT_NEAR(measured.y, kKeptDistance - 0.03f, 0.01f);
    EXPECT_LT(length(vec2(measured.x, measured.z)), 0.03f);
    const vec3 paper = relocated(vec3(0), sight, kRays, vec3(1), 1.0f, kRulesPaper);
    EXPECT_GT(paper.y, 0.1f) << "towards the farthest front";
    EXPECT_NEAR(length(paper), kRelocationStep, 1e-5f);
}

TEST(Relocation, aProbeThatSeesOneSurfaceStays) {
    const auto floor = [](vec3 d) { return d.y < -0.9f ? toPlane(d, {0, -1, 0}, 0.05f) : 1e30f; };
    EXPECT_EQ(relocated(vec3(0.1f), look(floor), kRays, vec3(1), 1.0f, kRulesPaper), vec3(0.1f));
    EXPECT_EQ(relocated(vec3(0.1f), nothingSeen(), kRays, vec3(1), 1.0f, kRulesPaper), vec3(0.1f)) << "nothing";
}

TEST(Relocation, aProbeInTheMiddleOfARoomStays) {
    const auto room = [](vec3 d) { return std::min(toPlane(d, {0, -1, 0}, 1.5f), toPlane(d, {0, 1, 0}, 2)); };
    EXPECT_EQ(relocated(vec3(0), look(room), kRays, vec3(1), 1.0f, kRulesMeasured), vec3(0));
}

TEST(Relocation, onlyProbesThatNoLookUpUsesTurnOff) {
    for (int backs = 0; backs <= 100; ++backs) {
        const SidesSeen seen{100, backs, backs};
        if (isOff(seen, 100, kRulesMeasured)) {
            EXPECT_EQ(outsideWeight(backfaceShareOf(backs, 100), kRulesMeasured), 0.0f) << backs;
            EXPECT_TRUE(isInside(seen, 100, kRulesMeasured));
        }
        EXPECT_EQ(isOff(seen, 100, kRulesPaper), backs > 25);
    }
    EXPECT_TRUE(isOff({100, 50, 50}, 100, kRulesMeasured));
}

TEST(Relocation, offsetsStayWithinTheLimit) {
    uint seed = 1;
    const auto random = [&] {
        seed = seed * 1664525u + 1013904223u;
        return float(seed >> 8) * (1.0f / 16777216.0f);
    };
    for (int scene = 0; scene < 2000; ++scene) {
        const vec3 spacing = vec3(0.5f) + vec3(random(), random(), random());
        vec3 offset(0);
        for (uint i = 0; i < kRelocations; ++i) {
            const PlaceSight sight =
                look([&](vec3) { return random() < 0.2f ? 1e30f : (random() - 0.4f) * 2.0f; }, random() < 0.5f);
            offset = relocated(offset, sight, kRays, spacing, std::min({spacing.x, spacing.y, spacing.z}), scene % 2);
            EXPECT_TRUE(isWithin(offset, kRelocationLimit * spacing * 1.0001f));
        }
    }
}

TEST(Relocation, curtainsDoNotMakeAProbeSolid) {
    // Half of the rays on backs of two-sided surfaces, half on fronts.
    SidesSeen seen{kRays, kRays / 2, 0};
    EXPECT_FALSE(isInside(seen, kRays, kRulesMeasured));
    EXPECT_TRUE(isInside(seen, kRays, kRulesPaper));
    seen.solidBacks = kRays / 2;
    EXPECT_TRUE(isInside(seen, kRays, kRulesMeasured));
    EXPECT_TRUE(isInside({kRays, kRays, 0}, kRays, kRulesMeasured)) << "nothing but backs";
    EXPECT_FALSE(isInside({0, 0, 0}, kRays, kRulesMeasured)) << "open air";
}

}  // namespace
}  // namespace probegi::kernels
