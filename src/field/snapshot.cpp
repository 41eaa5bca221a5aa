#include "field/snapshot.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/sentence.h"
#include "field/map_bilinear.h"
#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/probe_state.h"
#include "kernels/probe/probe_texel.h"
#include "kernels/volume/probe_offset.h"

namespace probegi {

namespace {

constexpr std::uint16_t kInfiniteHalf = 0x7c00;
constexpr int kLastFrame = 1 << 30;  // far from where counting would overflow

bool isShare(float x) {
    return x >= 0.0f && x <= 1.0f;
}

// A filter's words are pairs of halves, finite and not negative; one of them is stored plus one.
bool isPlacement(std::uint32_t placement) {
    const auto byte = [&](int shift) { return (placement >> shift & 0xffu) != 0x80u; };
    return kernels::stateOf(placement) < kernels::kProbeStates && byte(8) && byte(16) && byte(24);
}

bool storable(const ProbeState& state) {
    const auto half = [](std::uint32_t h) { return (h & 0xffffu) <= kInfiniteHalf; };
    return (isShare(state.backfaceShare) || state.backfaceShare == kernels::kNeverUpdated) && isShare(state.backs) &&
           isShare(state.fronts) && state.steps <= kernels::kNoWayOut && state.nextSteps <= kernels::kNoWayOut &&
           state.trust <= kernels::kMostTrust && isPlacement(state.placement) &&
           std::all_of(state.filter.begin(), state.filter.end(),
                       [&](std::uint32_t word) { return half(word) && half(word >> 16); });
}

Result<void> validateLengths(const FieldLayout& layout, const FieldSnapshot& snapshot) {
    const auto check = [&](const char* name, std::size_t have, std::size_t perProbe) -> Result<void> {
        const std::size_t wanted = std::size_t(snapshot.slots.count) * perProbe;
        if (have == wanted) return {};
        return fail(ErrorCode::invalidArgument, sentence("the snapshot's ", name, " has ", have, " entries; its ",
                                                         snapshot.slots.count, " slots need ", wanted));
    };
    if (auto ok = check("irradiance", snapshot.irradiance.size(), 3 * layout.irradianceTexels); !ok) return ok;
    if (auto ok = check("visibility", snapshot.visibility.size(), layout.visibilityTexels); !ok) return ok;
    return check("states", snapshot.states.size(), 1);
}

const VolumeDesc& volumeWithSlot(const FieldDesc& desc, int slot) {
    auto volume = desc.volumes.begin();
    for (; slot >= probeCount(*volume); ++volume) slot -= probeCount(*volume);
    return *volume;
}

}  // namespace

FieldSnapshot emptySnapshot(const FieldDesc& desc, SlotRange slots) {
    const FieldLayout layout(desc);
    FieldSnapshot snapshot;
    snapshot.desc = desc;
    snapshot.slots = slots;
    snapshot.scrolled.resize(desc.volumes.size());
    snapshot.irradiance.resize(std::size_t(slots.count) * 3 * layout.irradianceTexels);
    snapshot.visibility.resize(std::size_t(slots.count) * layout.visibilityTexels);
    snapshot.states.resize(std::size_t(slots.count));
    return snapshot;
}

Result<void> validateSlots(const FieldDesc& desc, SlotRange slots) {
    const int probes = probeCount(desc);
    if (slots.first >= 0 && slots.count >= 0 && slots.first <= probes && slots.count <= probes - slots.first) return {};
    return fail(ErrorCode::invalidArgument, sentence("there are no ", slots.count, " probes from slot ", slots.first,
                                                     " on; the field has ", probes, " slots"));
}

Result<void> validateSnapshot(const FieldDesc& desc, const FieldSnapshot& snapshot) {
    if (snapshot.desc.volumes != desc.volumes)
        return fail(ErrorCode::invalidArgument, "the snapshot is of a field with other volumes");
    if (snapshot.desc.irradianceTexels != desc.irradianceTexels ||
        snapshot.desc.visibilityTexels != desc.visibilityTexels)
        return fail(ErrorCode::invalidArgument,
                    sentence("the snapshot has maps of ", snapshot.desc.irradianceTexels, " and ",
                             snapshot.desc.visibilityTexels, " texels; the field's have ", desc.irradianceTexels,
                             " and ", desc.visibilityTexels));
    if (auto ok = validateSlots(desc, snapshot.slots); !ok) return ok;
    if (auto ok = validateLengths(FieldLayout(desc), snapshot); !ok) return ok;
    if (snapshot.scrolled.size() != desc.volumes.size())
        return fail(ErrorCode::invalidArgument,
                    sentence("the snapshot says of ", snapshot.scrolled.size(),
                             " volumes how far they were scrolled; it has ", desc.volumes.size()));
    for (const glm::ivec3& cells : snapshot.scrolled)
        if (glm::any(glm::greaterThan(glm::abs(glm::dvec3(cells)), glm::dvec3(kMostScrolled))))
            return fail(ErrorCode::invalidArgument, "the snapshot's volumes were scrolled too far");
    if (snapshot.frame < 0 || snapshot.frame > kLastFrame || snapshot.rayTurns < 0 ||
        snapshot.rayTurns > snapshot.frame)
        return fail(ErrorCode::invalidArgument, sentence("the snapshot cannot be of frame ", snapshot.frame, " after ",
                                                         snapshot.rayTurns, " turns of the rays"));
    if (!std::all_of(snapshot.irradiance.begin(), snapshot.irradiance.end(),
                     [](std::uint16_t half) { return half < kInfiniteHalf; }))
        return fail(ErrorCode::invalidArgument, "the snapshot's irradiance is not finite and positive everywhere");
    const auto onLattice = [](const ProbeState& state) { return state.placement < 0x100u; };
    if (!desc.relocation && !std::all_of(snapshot.states.begin(), snapshot.states.end(), onLattice))
        return fail(ErrorCode::invalidArgument,
                    "the snapshot's probes were relocated; make the field with relocation too");
    if (!std::all_of(snapshot.states.begin(), snapshot.states.end(), storable))
        return fail(ErrorCode::invalidArgument, "the snapshot has a probe state that no update stores");
    return {};
}

glm::vec3 ProbeState::offset() const noexcept {
    kernels::Volume unit{};
    unit.spacing = glm::vec3(1.0f);
    return kernels::probeOffset(unit, int(placement));
}

float ProbeState::confidence() const noexcept {
    return kernels::unpackFilter(filterOf(*this)).window / kernels::kLongestWindow;
}

ProbeState probeState(float backfaceShare, const kernels::ProbeSides& sides, const kernels::PackedProbeFilter& filter) {
    ProbeState state;
    state.backfaceShare = backfaceShare;
    state.backs = sides.backs;
    state.fronts = sides.fronts;
    state.steps = sides.steps;
    state.nextSteps = sides.nextSteps;
    state.trust = sides.trust;
    state.filter = std::to_array(filter.words);
    return state;
}

kernels::ProbeSides sidesOf(const ProbeState& state) noexcept {
    return {state.backs, state.fronts, state.steps, state.nextSteps, state.trust};
}

kernels::PackedProbeFilter filterOf(const ProbeState& state) noexcept {
    kernels::PackedProbeFilter packed;
    std::copy(state.filter.begin(), state.filter.end(), packed.words);
    return packed;
}

int FieldSnapshot::slotOf(int volume, int number) const noexcept {
    kernels::Volume v{};
    v.counts = desc.volumes[std::size_t(volume)].counts;
    v.phase = scrolledPhase(scrolled[std::size_t(volume)], v.counts);
    for (int i = 0; i < volume; ++i) v.firstSlot += probeCount(desc.volumes[std::size_t(i)]);
    const glm::ivec3& n = v.counts;
    return kernels::probeSlot(v, {number % n.x, number / n.x % n.y, number / (n.x * n.y)});
}

glm::vec3 FieldSnapshot::probeIrradiance(int slot, glm::vec3 normal) const noexcept {
    const int size = desc.irradianceTexels;
    const std::uint16_t* map = irradiance.data() + std::size_t(slot - slots.first) * 3 * std::size_t(size * size);
    const glm::vec3 stored = bilinearInMap(normal, size, [&](std::size_t texel) {
        return glm::vec3(kernels::unpackHalf(map[3 * texel]), kernels::unpackHalf(map[3 * texel + 1]),
                         kernels::unpackHalf(map[3 * texel + 2]));
    });
    return kernels::kPi * glm::vec3(kernels::decodeIrradiance(stored.x), kernels::decodeIrradiance(stored.y),
                                    kernels::decodeIrradiance(stored.z));
}

glm::vec2 FieldSnapshot::probeDistanceMoments(int slot, glm::vec3 direction) const noexcept {
    const int size = desc.visibilityTexels;
    const std::uint32_t* map = visibility.data() + std::size_t(slot - slots.first) * std::size_t(size * size);
    const float range = visibilityRange(volumeWithSlot(desc, slot));
    return bilinearInMap(direction, size, [&](std::size_t texel) { return kernels::unpackMoments(map[texel]); }) *
           glm::vec2(range, range * range);
}

}  // namespace probegi
