#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "kernels/volume/volume.h"
#include "probegi/field.h"

namespace probegi {

/// Farthest distance that visibility distinguishes, in diagonals of a grid cell: a point's eight probes are at most one
/// diagonal away; the rest leaves room for the moments' spread.
inline constexpr float kMaxDistanceInDiagonals = 1.5f;

/// Minimum probe spacing, metres.
inline constexpr float kSmallestSpacing = 1e-6f;
inline constexpr float kLargestSpacing = 1e9f;

/// Fewest probes per axis of a volume with tracksCamera: the box in which it answers has a middle of weight 1.
inline constexpr int kFewestTracking = 5;

/// Sizes that follow from a FieldDesc. A probe's texels are contiguous, row by row, without a border: on the CPU
/// octWrapTexel finds border texels instead of storing them twice.
struct FieldLayout {
    explicit FieldLayout(const FieldDesc& d)
        : probes(std::size_t(probeCount(d))),
          rays(std::size_t(d.raysPerProbe)),
          irradianceTexels(std::size_t(d.irradianceTexels) * d.irradianceTexels),
          visibilityTexels(std::size_t(d.visibilityTexels) * d.visibilityTexels) {}

    std::size_t probes;
    std::size_t rays;              ///< a probe
    std::size_t irradianceTexels;  ///< a probe
    std::size_t visibilityTexels;  ///< a probe
};

/// A field's volumes as kernels know them, in the order of the desc.
std::vector<kernels::Volume> makeVolumes(const FieldDesc& desc);
/// The same after scrolling by so many cells, by volume.
std::vector<kernels::Volume> makeVolumes(const FieldDesc& desc, std::span<const glm::ivec3> scrolled);

/// Cells that a volume may be scrolled by in all, along an axis: far from where sums overflow.
inline constexpr int kMostScrolled = 1'000'000'000;

/// kernels::Volume::phase after scrolling by so many cells.
inline glm::ivec3 scrolledPhase(glm::ivec3 cells, glm::ivec3 counts) {
    return (cells % counts + counts) % counts;  // GLM's remainder has the sign of the dividend
}

/// A volume after scrolling by so many cells.
VolumeDesc scrolledVolume(const VolumeDesc& volume, glm::ivec3 cells);

/// Which volume has the probe in a slot.
std::size_t volumeOf(std::span<const kernels::Volume> volumes, int slot);

/// Check every member. Errors: invalidArgument.
Result<void> validateFieldDesc(const FieldDesc& desc);
Result<void> validateFieldSettings(const FieldSettings& settings);
/// Whether the masks that the settings have are there where they are needed, and of these volumes, which must stand
/// where the desc has them. Errors: invalidArgument.
Result<void> validateGuard(const FieldDesc& desc, const FieldSettings& settings,
                           std::span<const glm::ivec3> scrolled = {});
/// Whether coordinates are fine enough where the volume stands. Errors: invalidArgument, with the volume's `name`.
Result<void> validateVolumePlace(const std::string& name, const VolumeDesc& volume);

}  // namespace probegi
