// Sphere tracing against exact intersection, and the rejection of clusters against looking at all theSolids.
#include <gtest/gtest.h>

#include <vector>

#include "kernels/sdf_access.h"
#include "kernels/sdf_solids.h"

#include "kernels/sdf/cluster.h"
#include "kernels/sdf/exact_hit.h"
#include "kernels/sdf/sphere_trace.h"

namespace probegi::kernels {
namespace {

constexpr int kGroups = 6, kOfEach = 8;

// Groups of solids within a metre and a half of their middles.
void placeGroups(SdfDice& dice) {
    theSolids.clear();
    theClusters.clear();
    for (int g = 0; g < kGroups; ++g) {
        const vec3 middle = dice.vector(-6, 6);
        for (int i = 0; i < kOfEach; ++i) {
            theSolids.push_back(randomSolid(dice, kSdfShapes[std::size_t(i % 5)]));
            theSolids.back().centre = middle + dice.vector(-0.8f, 0.8f);
            theSolids.back().halfSize *= 0.3f;
            theSolids.back().rounding *= 0.3f;
        }
        theClusters.push_back({middle, 2.2f, g * kOfEach, kOfEach});
    }
}

float distanceToAll(vec3 point) {
    float nearest = kSdfFar;
    for (const SdfSolid& solid : theSolids) nearest = min(nearest, sdfDistance(solid, point));
    return nearest;
}

TEST(SdfSphereTrace, rejectedClustersHaveNothingNearer) {
    SdfDice dice;
    int rejected = 0;
    for (int scene = 0; scene < 20; ++scene) {
        placeGroups(dice);
        for (int i = 0; i < 500; ++i) {
            const vec3 point = dice.vector(-8, 8);
            const float distance = distanceToAll(point);
            ASSERT_EQ(sdfNearest(point, kSdfFar, kGroups).distance, distance);
            for (const SdfCluster& cluster : theClusters) rejected += !sdfMayBeNearer(cluster, point, distance);
            // A bound below it finds nothing, one above it the same.
            ASSERT_EQ(sdfNearest(point, distance, kGroups).solid, -1);
            ASSERT_EQ(sdfNearest(point, distance + 1e-4f, kGroups).distance, distance);
        }
    }
    EXPECT_GT(rejected, 20 * 500 * kGroups / 2);
}

// Eq. 4.
TEST(SdfSphereTrace, theNextDistanceIsWithinTheBound) {
    SdfDice dice;
    placeGroups(dice);
    for (int i = 0; i < 5000; ++i) {
        const vec3 a = dice.vector(-8, 8);
        const float distance = distanceToAll(a);
        if (distance <= 0) continue;
        for (const float share : {0.5f, 1.0f, kSdfRelaxation}) {
            const float step = share * distance;
            ASSERT_GE(sdfNearest(a + dice.direction() * step, sdfBoundAfter(distance, step), kGroups).solid, 0);
        }
    }
    EXPECT_NEAR(sdfBoundAfter(2, 2), 4, 1e-3) << "twice the last distance";
}

TEST(SdfSphereTrace, hitsWhatExactIntersectionHits) {
    SdfDice dice;
    int hits = 0, other = 0, rays = 0;
    for (int scene = 0; scene < 10; ++scene) {
        placeGroups(dice);
        for (int i = 0; i < 1000; ++i) {
            const vec3 origin = dice.vector(-7, 7), target = theSolids[dice.generator() % theSolids.size()].centre;
            const vec3 direction =
                i % 2 == 0 ? dice.direction() : normalize(target + dice.vector(-0.3f, 0.3f) - origin);
            if (distanceToAll(origin) < 1e-3f) continue;
            ++rays;
            bool within = false;
            const SdfFound exact = sdfClosestHit(origin, 0, direction, 100, int(theSolids.size()), within);
            const SdfFound traced = sdfSphereTraced(origin, 0, direction, 100, kGroups);
            if ((exact.solid >= 0) != (traced.solid >= 0)) {
                ++other;  // barely touching, which rounding decides
                continue;
            }
            if (exact.solid < 0) continue;
            ++hits;
            const vec3 at = origin + direction * exact.distance;
            const float cosine = -dot(direction, sdfSurfaceNormal(sdfSolid(exact.solid), at));
            other += std::abs(exact.distance - traced.distance) > 1e-4f && cosine > 0.2f;
        }
    }
    EXPECT_GT(hits, rays / 10);
    EXPECT_LE(other, rays / 500);
}

TEST(SdfSphereTrace, endsAtFar) {
    theSolids = {plainSolid(kSdfSphere, vec3(1.0f))};
    theClusters = {{vec3(0.0f), 1, 0, 1}};
    EXPECT_NEAR(sdfSphereTraced({-5, 0, 0}, 0, {1, 0, 0}, 5, 1).distance, 4, 1e-4);
    EXPECT_NEAR(sdfSphereTraced({-5, 0, 0}, 3, {1, 0, 0}, 5, 1).distance, 4, 1e-4) << "begins nearer";
    EXPECT_EQ(sdfSphereTraced({-5, 0, 0}, 0, {1, 0, 0}, 3.9f, 1).solid, -1);
    EXPECT_EQ(sdfSphereTraced({-5, 0, 0}, 0, {-1, 0, 0}, 1e30f, 1).solid, -1);
    EXPECT_EQ(sdfSphereTraced({-5, 0, 0}, 0, {1, 0, 0}, 5, 0).solid, -1);
    EXPECT_FLOAT_EQ(sdfMeetsAt({-50, 3, 0}, 50), 1e-4f);
}

}  // namespace
}  // namespace probegi::kernels
