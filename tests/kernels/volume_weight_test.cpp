// How far volumes answer, and how they blend (section 7.4).
#include "kernels/volume/volume_weight.h"

#include <gtest/gtest.h>

#include <random>

#include "kernels/lookup/volume_blend.h"

namespace probegi::kernels {
namespace {

// From (1, 2, 3) to (5, 6, 11).
Volume makeVolume() {
    Volume v{};
    v.origin = vec3(1, 2, 3);
    v.spacing = vec3(0.5f, 1.0f, 2.0f);
    v.inverseSpacing = 1.0f / v.spacing;
    v.minSpacing = 0.5f;
    v.counts = ivec3(9, 5, 5);
    v.orientation = vec4(0, 0, 0, 1);
    return v;
}

// About y by a quarter turn: x goes to -z.
Volume quarterTurned() {
    Volume v = makeVolume();
    v.turned = 1;
    v.orientation = vec4(0, std::sqrt(0.5f), 0, std::sqrt(0.5f));
    return v;
}

TEST(VolumeWeight, countsCellsFromTheFaces) {
    const Volume v = makeVolume();
    EXPECT_FLOAT_EQ(cellsInVolume(v, {3, 4, 7}), 2.0f) << "the middle: two cells on y and z, four on x";
    EXPECT_FLOAT_EQ(cellsInVolume(v, {1.25f, 4, 7}), 0.5f);
    EXPECT_FLOAT_EQ(cellsInVolume(v, {4.75f, 5.75f, 7}), 0.25f) << "in an edge the lesser counts";
    EXPECT_FLOAT_EQ(cellsInVolume(v, v.origin), 0.0f);
    EXPECT_FLOAT_EQ(cellsInVolume(v, {3, 4, 14}), -1.5f) << "outside";
    // Turned about its origin: to x + 8 and z - 4.
    const Volume turned = quarterTurned();
    EXPECT_NEAR(cellsInVolume(turned, turned.origin + vec3(4, 2, -0.25f)), 0.5f, 1e-5f);
    EXPECT_NEAR(cellsInVolume(turned, turned.origin + vec3(9, 2, -2)), -0.5f, 1e-5f);
}

TEST(VolumeWeight, fallsOverTheLastCellAndCoverageBeyondIt) {
    EXPECT_EQ(volumeWeight(3.0f), 1.0f);
    EXPECT_EQ(volumeWeight(1.0f), 1.0f);
    EXPECT_FLOAT_EQ(volumeWeight(0.25f), 0.25f);
    EXPECT_EQ(volumeWeight(0.0f), 0.0f);
    EXPECT_EQ(volumeWeight(-2.0f), 0.0f);
    EXPECT_EQ(volumeCoverage(0.0f), 1.0f);
    EXPECT_EQ(volumeCoverage(-0.5f), 1.0f);
    EXPECT_FLOAT_EQ(volumeCoverage(-1.25f), 0.25f);
    EXPECT_EQ(volumeCoverage(-1.5f), 0.0f);
    EXPECT_EQ(withOutside(vec3(1, 2, 3), 1.0f, vec3(50)), vec3(1, 2, 3));
    EXPECT_EQ(withOutside(vec3(1, 2, 3), 0.0f, vec3(1)), vec3(kPi));
}

TEST(VolumeWeight, aTrackingVolumeAnswersAroundTheCamera) {
    const Volume v = makeVolume();
    const vec3 middle(3, 4, 7);
    // A cell less on each side.
    EXPECT_FLOAT_EQ(cellsInTrackingVolume(v, middle, middle), 1.0f);
    EXPECT_FLOAT_EQ(cellsInTrackingVolume(v, middle + vec3(0, 1, 0), middle), 0.0f);
    // It moves with the camera, less than a cell each way and never out of the window.
    EXPECT_FLOAT_EQ(cellsInTrackingVolume(v, middle + vec3(0, 1, 0), middle + vec3(0, 0.4f, 0)), 0.4f);
    EXPECT_LE(cellsInTrackingVolume(v, middle + vec3(0, 2.1f, 0), middle + vec3(0, 2.1f, 0)), -0.1f + 1e-5f);
}

// While the window leaps under it, a camera within a cell of the middle has the same weights.
TEST(VolumeWeight, theWindowsLeapChangesNothing) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto vector = [&] {
        const float x = unit(random), y = unit(random), z = unit(random);
        return vec3(x, y, z);
    };
    int weighed = 0, without = 0;
    for (Volume v : {makeVolume(), quarterTurned()})
        for (int i = 0; i < 2000; ++i) {
            const vec3 reach = 0.5f * vec3(v.counts - 1) * v.spacing;
            Volume leapt = v;
            leapt.origin += toWorldDirection(v, v.spacing * vec3(1, 0, 0));
            const vec3 camera =
                v.origin + toWorldDirection(v, reach + v.spacing * vec3(0.5f + 0.49f * unit(random), 0, 0));
            const vec3 point = v.origin + toWorldDirection(v, reach + 1.2f * reach * vector());
            const float before = volumeWeight(cellsInTrackingVolume(v, point, camera));
            EXPECT_NEAR(before, volumeWeight(cellsInTrackingVolume(leapt, point, camera)), 1e-4f);
            weighed += before > 0 && before < 1 ? 1 : 0;
            without +=
                std::abs(volumeWeight(cellsInVolume(v, point)) - volumeWeight(cellsInVolume(leapt, point))) > 0.5f;
        }
    EXPECT_GT(weighed, 300);
    EXPECT_GT(without, 100) << "without the camera they leap";
}

VolumeAnswer saying(float irradiance, float weight = 1.0f) {
    return {vec3(irradiance), weight};
}

TEST(VolumeBlend, densestFirstUntilTheWeightsAreWhole) {
    VolumeBlend blend = emptyBlend();
    EXPECT_FLOAT_EQ(nextWeight(blend, 0.25f), 0.25f);
    blend = withVolume(blend, saying(8), 0.25f);
    EXPECT_EQ(blend.irradiance, vec3(8)) << "alone it answers, whatever its weight";
    EXPECT_FLOAT_EQ(nextWeight(blend, 5.0f), 0.75f) << "no more than what lacks";
    blend = withVolume(blend, saying(4), 0.75f);
    EXPECT_FLOAT_EQ(blend.irradiance.x, 5.0f);
    EXPECT_EQ(nextWeight(blend, 5.0f), 0.0f);
    // Rounding of sums asks no one.
    blend.total = 0.99995f;
    EXPECT_EQ(nextWeight(blend, 5.0f), 0.0f);
}

TEST(VolumeBlend, whoKnowsNothingHasNoWeight) {
    VolumeBlend blend = withVolume(emptyBlend(), saying(0, 0), 1.0f);
    EXPECT_EQ(blend.total, 0.0f);
    EXPECT_EQ(nextWeight(blend, 5.0f), 1.0f);
    blend = withNearest(blend, saying(3, 0), 1.0f);
    EXPECT_TRUE(isNearer(blend, 100.0f));
    blend = withNearest(blend, saying(3), 100.0f);
    EXPECT_EQ(blend.irradiance, vec3(3));
    EXPECT_FALSE(isNearer(blend, 100.0f)) << "of equally near ones the first stays";
    EXPECT_TRUE(isNearer(blend, 99.0f));
}

TEST(VolumeBlend, equalAnswersStayWhatTheyAre) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> weight(0.001f, 0.3f);
    for (int i = 0; i < 100; ++i) {
        const float e = 0.1f + float(i) / 7;
        VolumeBlend blend = emptyBlend();
        for (int k = 0; k < 5; ++k) blend = withVolume(blend, saying(e), nextWeight(blend, weight(random)));
        EXPECT_EQ(blend.irradiance, vec3(e)) << "to the bit";
    }
}

}  // namespace
}  // namespace probegi::kernels
