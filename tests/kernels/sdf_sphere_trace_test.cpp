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
        for (const float share : {0.5f, 1.0f, 1.5f, 19.0f}) {
            const float step = share * distance;
            ASSERT_GE(sdfNearest(a + dice.direction() * step, sdfBoundAfter(distance, step), kGroups).solid, 0);
        }
    }
    EXPECT_NEAR(sdfBoundAfter(2, 2), 4, 1e-3) << "twice the last distance";
}

// Before a plane the spheres of two steps nearly touch, and are never apart.
TEST(SdfSphereTrace, theStepBeforeAPlaneIsPredicted) {
    const float distance = 0.7f;
    for (const float cosine : {-0.8f, 0.0f, 0.3f, 0.9f, 1.0f})
        for (const float last : {1e-3f, 0.5f, 100.0f}) {
            const float step = sdfPredictedStep(distance, last, last * cosine);
            const float touches = 2 * distance / (1 + cosine);
            EXPECT_NEAR(step, distance + kSdfRelaxation * (touches - distance), 1e-5f) << cosine;
            EXPECT_LE(step, touches * 1.0001f) << cosine;
        }
    EXPECT_EQ(sdfPredictedStep(distance, 0, 0.4f), distance) << "the first step";
    EXPECT_EQ(sdfPredictedStep(distance, 1, 1.1f), distance) << "a fall of more than the step, by rounding";
    EXPECT_NEAR(sdfPredictedStep(distance, 1, -1), 19 * distance, 1e-4f) << "straight away";
}

// Without predicted steps.
SdfFound plainlyTraced(vec3 origin, vec3 direction, float far) {
    for (float t = 0; t <= far;) {
        SdfFound at = sdfNearest(origin + direction * t, kSdfFar, int(theClusters.size()));
        if (at.distance <= sdfMeetsAt(origin, t)) {
            at.distance = t;
            return at;
        }
        t += at.distance;
    }
    return sdfFoundNone(far);
}

// As many boxes as the paper has for Sponza, in a closed room.
void placeRoom(SdfDice& dice) {
    theSolids.clear();
    for (int i = 0; i < 37; ++i) {
        theSolids.push_back(plainSolid(kSdfBox, dice.vector(0.1f, 1)));
        theSolids.back().centre = dice.vector(-5, 5);
        theSolids.back().rotation = dice.rotation();
    }
    for (const int axis : {0, 1, 2})
        for (const float side : {-6.0f, 6.0f}) {
            theSolids.push_back(plainSolid(kSdfBox, vec3(6)));
            theSolids.back().halfSize[axis] = 0.1f;
            theSolids.back().centre[axis] = side;
        }
    theClusters = {{vec3(0.0f), 50, 0, int(theSolids.size())}};
}

// 25 distances a ray with steps of 1.5 distances, 19 with plain ones.
TEST(SdfSphereTrace, predictedStepsHitTheSameWithFewerDistances) {
    SdfDice dice;
    placeRoom(dice);
    int hits = 0, other = 0, reads = 0, plainReads = 0;
    for (int i = 0; i < 4000; ++i) {
        const vec3 origin = dice.vector(-5.5f, 5.5f), direction = dice.direction();
        if (distanceToAll(origin) < 1e-3f) continue;
        theClusterReads = 0;
        const SdfFound traced = sdfSphereTraced(origin, 0, direction, 100, 1);
        reads += theClusterReads;
        theClusterReads = 0;
        const SdfFound plain = plainlyTraced(origin, direction, 100);
        plainReads += theClusterReads;
        ASSERT_GE(plain.solid, 0);
        ++hits;
        // Along a surface either way may end a little earlier.
        const float cosine = -dot(direction, sdfGradient(sdfSolid(plain.solid), origin + direction * plain.distance));
        other += traced.solid < 0 || (std::abs(traced.distance - plain.distance) > 1e-4f && cosine > 0.2f);
    }
    EXPECT_GT(hits, 3000);
    EXPECT_LE(other, hits / 1000);
    EXPECT_LT(reads, 0.9 * plainReads);
    EXPECT_LT(reads, 17 * hits);
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
