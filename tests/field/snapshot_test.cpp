#include "field/snapshot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/storage.h"

namespace probegi {
namespace {

constexpr float kPi = 3.14159265f;

FieldDesc twoVolumes() {
    FieldDesc desc;
    desc.volumes = {{.spacing = {1, 1, 1}, .counts = {2, 2, 2}}, {.spacing = {3, 2, 1}, .counts = {2, 3, 2}}};
    desc.irradianceTexels = 32;
    return desc;
}

// Half of the encoded mean radiance, rounded to nearest.
std::uint16_t encoded(float meanRadiance) {
    return std::uint16_t(kernels::packHalfDithered(std::pow(meanRadiance, 0.2f), 4096));
}

// Radiance 1 + z / 2 by the direction of each texel, in one probe's map.
void paint(FieldSnapshot& snapshot, int slot) {
    const int size = snapshot.desc.irradianceTexels;
    std::uint16_t* map =
        snapshot.irradiance.data() + std::size_t(slot - snapshot.slots.first) * 3 * std::size_t(size * size);
    for (int t = 0; t < size * size; ++t)
        for (int c = 0; c < 3; ++c)
            map[3 * t + c] =
                encoded((1 + 0.5f * kernels::octTexelDirection(t % size, t / size, size).z) * float(c + 1));
}

TEST(FieldSnapshot, irradianceIsWhatWasPainted) {
    FieldSnapshot snapshot = emptySnapshot(twoVolumes(), {6, 4});
    paint(snapshot, 8);
    for (int i = 0; i < 200; ++i) {
        const float z = 1 - 2 * (float(i) + 0.5f) / 200, angle = 2.4f * float(i), r = std::sqrt(1 - z * z);
        const glm::vec3 e = snapshot.probeIrradiance(8, {r * std::cos(angle), r * std::sin(angle), z});
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c] / (kPi * float(c + 1)), 1 + 0.5f * z, 0.02f) << i;
        EXPECT_EQ(snapshot.probeIrradiance(7, {0, 0, 1}), glm::vec3(0.0f)) << "the neighbour is black";
    }
}

TEST(FieldSnapshot, texelsAreReadAtTheirCentres) {
    FieldSnapshot snapshot = emptySnapshot(twoVolumes(), {0, 20});
    paint(snapshot, 3);
    for (const int t : {0, 31, 400, 990, 1023}) {
        const glm::vec3 d = kernels::octTexelDirection(t % 32, t / 32, 32);
        const float stored = kernels::unpackHalf(snapshot.irradiance[std::size_t(3 * 3 * 1024 + 3 * t)]);
        EXPECT_NEAR(snapshot.probeIrradiance(3, d).x, kPi * std::pow(stored, 5.0f), 1e-4f);
    }
}

TEST(FieldSnapshot, distancesAreSharesOfTheVolumesRange) {
    const FieldDesc desc = twoVolumes();
    FieldSnapshot snapshot = emptySnapshot(desc, {0, 20});
    std::fill(snapshot.visibility.begin(), snapshot.visibility.end(), 0x4000'8000u);  // mean 1/2, mean square 1/4
    EXPECT_NEAR(visibilityRange(desc.volumes[1]), 1.5f * std::sqrt(14.0f), 1e-5f);
    for (const auto& [slot, volume] : {std::pair(7, 0), std::pair(8, 1), std::pair(19, 1)}) {
        const float range = visibilityRange(desc.volumes[std::size_t(volume)]);
        const glm::vec2 moments = snapshot.probeDistanceMoments(slot, glm::normalize(glm::vec3(1, -2, 0.5f)));
        EXPECT_NEAR(moments.x, 0.5f * range, 1e-4f * range) << slot;
        EXPECT_NEAR(moments.y, 0.25f * range * range, 1e-4f * range * range) << slot;
    }
}

TEST(FieldSnapshot, aStateIsItsParts) {
    const kernels::ProbeSides sides{0.25f, 0.5f, 3, 4, 5};
    kernels::PackedProbeFilter filter;
    for (unsigned i = 0; i < 8; ++i) filter.words[i] = 100 + i;
    const ProbeState state = probeState(0.75f, sides, filter);
    EXPECT_EQ(state.backfaceShare, 0.75f);
    EXPECT_EQ(state.backs, 0.25f);
    EXPECT_EQ(state.fronts, 0.5f);
    EXPECT_EQ(state.steps, 3u);
    EXPECT_EQ(state.nextSteps, 4u);
    EXPECT_EQ(state.trust, 5u);
    EXPECT_EQ(probeState(0.75f, sidesOf(state), filterOf(state)), state);
    EXPECT_EQ(state.filter[7], 107u);
}

// Numbers count the cells of the window where it stands; slots stay with the places.
TEST(FieldSnapshot, slotsOfNumbersGoAlongWithScrolling) {
    FieldSnapshot snapshot = emptySnapshot(twoVolumes(), {0, 20});
    for (int number = 0; number < 8; ++number) EXPECT_EQ(snapshot.slotOf(0, number), number);
    for (int number = 0; number < 12; ++number) EXPECT_EQ(snapshot.slotOf(1, number), 8 + number);
    snapshot.scrolled[1] = {-1, 4, 7};
    const std::vector<kernels::Volume> volumes = makeVolumes(snapshot.desc, snapshot.scrolled);
    for (int number = 0; number < 12; ++number) {
        const glm::ivec3 cell(number % 2, number / 2 % 3, number / 6);
        EXPECT_EQ(snapshot.slotOf(1, number), kernels::probeSlot(volumes[1], cell)) << number;
        EXPECT_EQ(kernels::probeNumber(volumes[1], snapshot.slotOf(1, number)), number);
    }
}

TEST(FieldSnapshot, slotsThatAreNotThere) {
    const FieldDesc desc = twoVolumes();
    EXPECT_TRUE(validateSlots(desc, {0, 20}));
    EXPECT_TRUE(validateSlots(desc, {20, 0}));
    for (const SlotRange bad : {SlotRange{0, 21}, SlotRange{21, 0}, SlotRange{-1, 1}, SlotRange{3, -1}})
        EXPECT_EQ(validateSlots(desc, bad).error().code, ErrorCode::invalidArgument);
}

}  // namespace
}  // namespace probegi
