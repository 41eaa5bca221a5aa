#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "probegi/control.h"
#include "probegi/export.h"

namespace probegi {

/// Consecutive probes of a field.
struct SlotRange {
    int first = 0;  ///< slot
    int count = 0;

    bool operator==(const SlotRange&) const = default;
};

/// What a probe keeps from update to update besides its maps.
struct ProbeState {
    /// Share of its rays' hits that were on backs and indicate solid geometry, 0..1; above 0.3 the probe stands in a
    /// wall and is not used; 2: it is new to its place or not updated at all, and not used. Backs of surfaces with two
    /// sides do not count while a free line leads from the probe, by way of its neighbours, to one that sees fronts.
    float backfaceShare = 0;
    float backs = 0;              ///< share of its rays that hit backs, whatever the material, 0..1
    float fronts = 0;             ///< share of its rays that hit fronts, 0..1
    std::uint32_t steps = 0;      ///< of its path into the open, from probe to probe, 0..255; 255: there is none
    std::uint32_t nextSteps = 0;  ///< the same for the next update
    std::uint32_t trust = 0;      ///< in the path, 0..16
    /// The temporal filter, packed (src/kernels/blend/temporal_filter.h).
    std::array<std::uint32_t, 8> filter{};
    /// Activity and offset, packed (src/kernels/volume/probe_offset.h, src/kernels/probe/probe_state.h).
    std::uint32_t placement = std::uint32_t(ProbeActivity::vigilant);

    ProbeActivity activity() const noexcept { return ProbeActivity(placement & 7u); }
    /// The window over which the probe averages, over the longest: 0 of a new probe, short after a change, 1 after a
    /// few hundred updates without one.
    PROBEGI_API float confidence() const noexcept;
    /// From the probe's place in the lattice, along the volume's axes, in shares of its spacing, -0.5..0.5.
    PROBEGI_API glm::vec3 offset() const noexcept;

    bool operator==(const ProbeState&) const = default;
};

/// Some or all probes of a field as they are stored, to look at, to keep, or to give to a field with the same volumes
/// and maps. All backends store the same formats, so a field of one can be written with a snapshot of another. Made by
/// Field::read().
struct PROBEGI_API FieldSnapshot {
    FieldDesc desc;                    ///< of the field
    int frame = 0;                     ///< FieldControl::frame()
    int rayTurns = 0;                  ///< how often the rays were turned: below `frame` after Field::converge()
    std::vector<glm::ivec3> scrolled;  ///< per volume: how far its window was scrolled, cells
    SlotRange slots;                   ///< stored here
    /// Half floats, encoded (E / pi)^(1/5): [slot][texel][rgb], rows of the octahedral map from the top, no border.
    std::vector<std::uint16_t> irradiance;
    /// Mean (low 16 bits) and mean square (high 16 bits) of distance / visibilityRange(), unorm: [slot][texel].
    std::vector<std::uint32_t> visibility;
    std::vector<ProbeState> states;  ///< [slot]

    /// Of the probe in slot `slot`, which must be one of `slots`.
    const ProbeState& state(int slot) const noexcept { return states[std::size_t(slot - slots.first)]; }
    /// Slot of the probe with a number (VolumeDesc) in a volume as it stood: they differ once the volume has scrolled.
    /// Unchecked.
    int slotOf(int volume, int number) const noexcept;
    /// E in W m^-2 for a surface facing the unit vector `normal` at the probe itself. Unchecked.
    glm::vec3 probeIrradiance(int slot, glm::vec3 normal) const noexcept;
    /// Mean and mean square of the distance to what the probe sees along a unit vector, metres and square metres.
    /// Unchecked.
    glm::vec2 probeDistanceMoments(int slot, glm::vec3 direction) const noexcept;
};

/// Farthest distance that the probes of a volume store, metres.
PROBEGI_API float visibilityRange(const VolumeDesc& volume) noexcept;

}  // namespace probegi
