#include "kernels/volume/probe_cage.h"

#include <gtest/gtest.h>

#include "kernels/lookup/probe_neighbours.h"

namespace probegi::kernels {
namespace {

const ivec3 kCounts(4, 5, 6);

// As far as (2.5, 6, 13).
Volume someVolume() {
    Volume v{};
    v.origin = vec3(1, 2, 3);
    v.spacing = vec3(0.5f, 1, 2);
    v.inverseSpacing = 1.0f / v.spacing;
    v.counts = kCounts;
    return v;
}
const Volume kVolume = someVolume();

TEST(ProbeCage, pointsOutsideMoveToTheGridsFaces) {
    EXPECT_EQ(clampToVolume(kVolume, {2, 3, 4}), vec3(2, 3, 4));
    EXPECT_EQ(clampToVolume(kVolume, {-9, 99, 4}), vec3(1, 6, 4));
    EXPECT_EQ(clampToVolume(kVolume, {99, -9, 99}), vec3(2.5f, 2, 13));
}

TEST(ProbeCage, coordinatesCountSpacings) {
    EXPECT_EQ(gridCoordinates(kVolume, {1.75f, 4, 4}), vec3(1.5f, 2, 0.5f));
}

TEST(ProbeCage, theCageIsAroundThePoint) {
    const vec3 inside(1.5f, 2.25f, 0.5f);
    EXPECT_EQ(cageBase(kVolume, inside), vec3(1, 2, 0));
    EXPECT_EQ(cageAlpha(inside, vec3(1, 2, 0)), vec3(0.5f, 0.25f, 0.5f));
    // On and beyond the last probes: the last cage, at its end.
    EXPECT_EQ(cageBase(kVolume, {3, 4, 5}), vec3(2, 3, 4));
    EXPECT_EQ(cageAlpha({3, 4, 5}, {2, 3, 4}), vec3(1.0f));
    EXPECT_EQ(cageAlpha({3.5f, 4, 5}, {2, 3, 4}), vec3(1.0f));
    EXPECT_EQ(cageBase(kVolume, {-0.5f, -3, 0}), vec3(0.0f));
    EXPECT_EQ(cageAlpha({-0.5f, -3, 0}, vec3(0.0f)), vec3(0.0f));
}

// Face by face: 4 below and 4 above along each axis.
TEST(ProbeCage, neighboursAreFourASide) {
    for (int axis = 0; axis < 3; ++axis)
        for (const int along : {-1, 2}) {
            int count = 0;
            for (int i = 0; i < kNeighbours; ++i) count += neighbourCell(ivec3(0), i)[axis] == along ? 1 : 0;
            EXPECT_EQ(count, 4) << axis << ' ' << along;
        }
}

// Less than half a thousandth of weight is doubt; in full doubt a point far from all probes has light nevertheless.
TEST(ProbeNeighboursDoubt, beginsBelowHalfAThousandth) {
    const vec3 cage = vec3(2.0f), neighbours = kPi * vec3(9.0f);
    EXPECT_NEAR(completedByNeighbours(cage * 0.0005f, 0.0005f, neighbours).x, 4 * kPi, 1e-3f);
    EXPECT_NEAR(completedByNeighbours(cage * 0.0001f, 0.0001f, neighbours).x, 2.8f * 2.8f * kPi, 1e-3f);
    EXPECT_EQ(neighbourWeight(1, vec3(0.0f), vec3(0, 0, 1), 1, 2), crushWeight(backfaceWeight(0, kRulesMeasured)));
}

TEST(ProbeQuery, noViewerIsTheNormal) {
    EXPECT_EQ(viewerOf(vec3(0.0f), vec3(0, 0, 1)), vec3(0, 0, 1));
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            vec3 viewer(0.0f);
            viewer[axis] = sign;
            EXPECT_EQ(viewerOf(viewer, vec3(0.5f)), viewer);
        }
    EXPECT_EQ(viewerOf({0.6f, -0.6f, 0.1f}, vec3(0, 0, 1)), vec3(0.6f, -0.6f, 0.1f));
}

// On a probe the rounding of a place has no side; half a spacing away the cosine is right within a per cent.
TEST(ProbeQuery, aProbeHasNoSideWhereThePointStands) {
    EXPECT_EQ(cosineToProbe(0, 0, 2), 0.0f);
    EXPECT_LT(cosineToProbe(1e-6f, 1e-6f, 2), 1e-3f);
    EXPECT_NEAR(cosineToProbe(0.5f, 1, 2), 0.5 / 1.002, 1e-6);
    EXPECT_NEAR(cosineToProbe(-1, 1, 2), -1 / 1.002, 1e-6);
}

// The share of hits on backs at which a probe fades, and where nothing of it is left.
TEST(ProbeQuery, aProbeInAWallFadesBetweenAQuarterAndThirtyPerCent) {
    EXPECT_EQ(outsideWeight(0.25f, kRulesMeasured), 1.0f);
    EXPECT_NEAR(outsideWeight(0.26f, kRulesMeasured), 0.8f, 1e-5f);
    EXPECT_NEAR(outsideWeight(0.29f, kRulesMeasured), 0.2f, 1e-5f);
    EXPECT_NEAR(outsideWeight(0.3f, kRulesMeasured), 0.0f, 1e-5f);
    EXPECT_EQ(outsideWeight(0.31f, kRulesMeasured), 0.0f);
    EXPECT_EQ(outsideWeight(0.31f, kRulesPaper), 1.0f);
}

// w^3 / 0.2^2 below a fifth.
TEST(ProbeQuery, smallWeightsAreCrushed) {
    EXPECT_FLOAT_EQ(crushWeight(0.1f), 0.025f);
    EXPECT_FLOAT_EQ(crushWeight(0.19f), 0.19f * 0.19f * 0.19f * 25);
    EXPECT_EQ(crushWeight(0.21f), 0.21f);
    EXPECT_EQ(crushWeight(0), 0.0f);
}

// A thousandth of the weight is left for the far side of a cell's face.
TEST(ProbeQuery, noCornerOfTheCageIsForgotten) {
    EXPECT_EQ(trilinearFactor(0, 1), 0.001f);
    EXPECT_EQ(trilinearFactor(1, 0), 0.001f);
    EXPECT_EQ(trilinearFactor(1, 0.25f), 0.25f);
    EXPECT_EQ(trilinearFactor(0, 0.25f), 0.75f);
}

}  // namespace
}  // namespace probegi::kernels
