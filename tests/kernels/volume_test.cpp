// Slots, cells, frames and tiles: a probe's place in the pool, in the world and in an atlas.
#include "kernels/volume/volume.h"

#include <gtest/gtest.h>

#include <set>

#include "kernels/abi/field_constants.h"
#include "kernels/volume/pool.h"
#include "kernels/volume/probe_cage.h"
#include "kernels/volume/volume_choice.h"
#include "kernels/volume/volume_frame.h"

namespace probegi::kernels {
namespace {

Volume makeVolume(ivec3 counts, ivec3 phase = ivec3(0), int firstSlot = 0) {
    Volume v{};
    v.origin = vec3(1, 2, 3);
    v.spacing = vec3(0.5f, 1, 2);
    v.inverseSpacing = 1.0f / v.spacing;
    v.minSpacing = 0.5f;
    v.inverseMaxDistance = 0.25f;
    v.counts = counts;
    v.phase = phase;
    v.firstSlot = firstSlot;
    return v;
}

// A quarter turn about the y axis: the volume's x is the world's -z.
Volume quarterTurned(ivec3 counts) {
    Volume v = makeVolume(counts);
    v.turned = 1;
    v.orientation = vec4(0, std::sqrt(0.5f), 0, std::sqrt(0.5f));
    return v;
}

template <class Visit>
void forEachCell(ivec3 counts, Visit visit) {
    for (int z = 0; z < counts.z; ++z)
        for (int y = 0; y < counts.y; ++y)
            for (int x = 0; x < counts.x; ++x) visit(ivec3(x, y, z));
}

void expectNear(vec3 got, vec3 want, float tolerance = 1e-6f) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(got[axis], want[axis], tolerance) << axis;
}

TEST(Volume, slotsCountXFirst) {
    const Volume v = makeVolume({4, 3, 5}, ivec3(0), 7);
    int slot = 7;
    forEachCell(v.counts, [&](ivec3 cell) {
        EXPECT_EQ(probeSlot(v, cell), slot);
        EXPECT_EQ(probeCell(v, slot++), cell);
    });
    EXPECT_EQ(volumeProbes(v), 60);
}

// In every phase, cells and the slots of the volume's range correspond one to one.
TEST(Volume, slotsAndCellsAreOneToOneInEveryPhase) {
    const ivec3 counts(2, 3, 4);
    forEachCell(counts, [&](ivec3 phase) {
        const Volume v = makeVolume(counts, phase, 100);
        std::set<int> slots;
        forEachCell(counts, [&](ivec3 cell) {
            const int slot = probeSlot(v, cell);
            EXPECT_EQ(probeCell(v, slot), cell);
            slots.insert(slot);
        });
        EXPECT_EQ(slots.size(), 24u);
        EXPECT_EQ(*slots.begin(), 100);
        EXPECT_EQ(*slots.rbegin(), 123);
    });
}

// After scrolling by a cell, a probe that stays keeps its slot under new coordinates.
TEST(Volume, probesThatStayKeepTheirSlots) {
    const ivec3 counts(5, 4, 3);
    const Volume before = makeVolume(counts, {4, 3, 1}), after = makeVolume(counts, {0, 3, 1});
    forEachCell(counts, [&](ivec3 cell) {
        if (cell.x + 1 < counts.x) {
            EXPECT_EQ(probeSlot(after, cell), probeSlot(before, cell + ivec3(1, 0, 0)));
        }
    });
    EXPECT_EQ(ringPlace(3, 4, 5), 2);
    EXPECT_EQ(ringPlace(0, 4, 5), 4);
}

TEST(Volume, knowsItsCells) {
    const Volume v = makeVolume({2, 3, 4});
    EXPECT_TRUE(isInVolume(v, ivec3(0)) && isInVolume(v, {1, 2, 3}));
    for (const ivec3 cell :
         {ivec3(-1, 0, 0), ivec3(0, -1, 0), ivec3(0, 0, -1), ivec3(2, 0, 0), ivec3(0, 3, 0), ivec3(0, 0, 4)})
        EXPECT_FALSE(isInVolume(v, cell));
    EXPECT_EQ(probePlace(v, {1, 2, 3}), vec3(1.5f, 4, 9));
}

TEST(CageSlots, areTheSlotsOfTheEightCells) {
    const ivec3 counts(3, 4, 5);
    forEachCell(counts, [&](ivec3 phase) {
        const Volume v = makeVolume(counts, phase, 60);
        forEachCell(counts - 1, [&](ivec3 base) {
            const CageSlots slots = cageSlots(v, vec3(base));
            for (int corner = 0; corner < 8; ++corner)
                EXPECT_EQ(cornerSlot(v, slots, corner),
                          probeSlot(v, base + ivec3(corner & 1, corner >> 1 & 1, corner >> 2)));
        });
    });
    EXPECT_EQ(ringOffset(2, 3, 4, 10), 10);
    EXPECT_EQ(nextInRing(30, 10, 40), 0);
    EXPECT_EQ(nextInRing(20, 10, 40), 30);
}

TEST(VolumeFrame, aQuarterTurnTurnsAQuarter) {
    const Volume v = quarterTurned({2, 2, 2});
    expectNear(toWorldDirection(v, {1, 0, 0}), {0, 0, -1});
    expectNear(toWorldDirection(v, {0, 1, 0}), {0, 1, 0});
    expectNear(toVolumeDirection(v, {0, 0, -1}), {1, 0, 0});
    expectNear(turnedBy({0, std::sqrt(0.5f), 0}, std::sqrt(0.5f), {0, 0, 1}), {1, 0, 0});
    // Turned about the origin, which does not move.
    expectNear(toVolumePoint(v, v.origin), v.origin);
    expectNear(toVolumePoint(v, v.origin + vec3(0, 0, -2)), v.origin + vec3(2, 0, 0));
    expectNear(probePosition(v, {1, 0, 0}), v.origin + vec3(0, 0, -0.5f));
}

TEST(VolumeFrame, whatIsNotTurnedStaysAsItIs) {
    const Volume v = makeVolume({2, 2, 2});  // its orientation is not a rotation
    EXPECT_EQ(toWorldDirection(v, {1, 2, 3}), vec3(1, 2, 3));
    EXPECT_EQ(toVolumeDirection(v, {1, 2, 3}), vec3(1, 2, 3));
    EXPECT_EQ(toVolumePoint(v, {1, 2, 3}), vec3(1, 2, 3));
    EXPECT_EQ(probePosition(v, {1, 1, 1}), probePlace(v, {1, 1, 1}));
}

TEST(VolumeChoice, theFirstThatHoldsThePoint) {
    Volume far = makeVolume({2, 2, 2}), near = far;
    far.origin.x = 101;
    const auto choose = [&](vec3 point) {
        VolumeChoice choice = noVolume();
        choice = chooseVolume(choice, far, 0, point);
        choice = chooseVolume(choice, near, 1, point);
        return chooseVolume(choice, near, 2, point).volume;
    };
    EXPECT_EQ(choose(near.origin), 1);  // on its face
    EXPECT_EQ(choose(far.origin + 0.1f), 0);
    EXPECT_EQ(choose({50, 2, 3}), 1);  // outside of both
    EXPECT_EQ(choose({53, 2, 3}), 0);
    EXPECT_EQ(choose({51.25f, 2, 3}), 0);  // equally far from both
}

TEST(VolumeChoice, distancesAreThoseToTheVolume) {
    const Volume v = makeVolume({3, 3, 3});  // (1, 2, 3) to (2, 4, 7)
    EXPECT_EQ(squareDistanceToVolume(v, {1.5f, 3, 4}), 0.0f);
    EXPECT_EQ(squareDistanceToVolume(v, {-1, 3, 10}), 4.0f + 9.0f);
    // Turned, it extends from its origin to x + 4 and z - 1.
    const Volume turned = quarterTurned({3, 3, 3});
    EXPECT_NEAR(squareDistanceToVolume(turned, turned.origin + vec3(4, 1, -1)), 0.0f, 1e-6f);
    EXPECT_NEAR(squareDistanceToVolume(turned, turned.origin + vec3(6, 1, -4)), 4.0f + 9.0f, 1e-4f);
}

TEST(Pool, tilesFillRowsThenLayers) {
    const PoolTiles tiles{2, 5};  // rows of 4, layers of 32
    EXPECT_EQ(poolTile(tiles, 0), ivec3(0, 0, 0));
    EXPECT_EQ(poolTile(tiles, 5), ivec3(1, 1, 0));
    EXPECT_EQ(poolTile(tiles, 31), ivec3(3, 7, 0));
    EXPECT_EQ(poolTile(tiles, 32), ivec3(0, 0, 1));
    EXPECT_EQ(poolTile(tiles, 32 * 9 + 6), ivec3(2, 1, 9));
}

// Maps of 8 texels with a border of one lie 10 apart.
TEST(FieldConstants, holdAsManyVolumesAsAFieldMayHave) {
    EXPECT_EQ(sizeof(FieldConstants),
              48 + kMostVolumes * sizeof(Volume) + sizeof(VolumeBlending) + sizeof(RaySet) + 28);
    EXPECT_GE(kMostVolumes, 16);
}

}  // namespace
}  // namespace probegi::kernels
