#include "field/layout.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "probegi/snapshot.h"

namespace probegi {

float visibilityRange(const VolumeDesc& volume) noexcept {
    return kMaxDistanceInDiagonals * glm::length(volume.spacing);
}

std::size_t volumeOf(std::span<const kernels::Volume> volumes, int slot) {
    std::size_t volume = 0;
    while (volume + 1 < volumes.size() && slot >= volumes[volume + 1].firstSlot) ++volume;
    return volume;
}

glm::ivec3 cellsToCentre(const VolumeDesc& volume, glm::vec3 point) noexcept {
    const glm::vec3 inVolume = glm::conjugate(volume.orientation) * (point - volume.origin);
    // Down from the half, so that a point on the seam of two cells moves the window once only.
    const glm::vec3 cells = glm::floor(inVolume / volume.spacing - 0.5f * glm::vec3(volume.counts - 1) + 0.5f);
    glm::ivec3 result(0);
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isnan(cells[axis]))
            result[axis] = int(std::clamp(cells[axis], -float(kMostScrolled), float(kMostScrolled)));
    return result;
}

glm::ivec3 cellsToFollow(const VolumeDesc& volume, glm::vec3 camera, float deadBand) noexcept {
    const glm::vec3 inVolume = glm::conjugate(volume.orientation) * (camera - volume.origin);
    const glm::vec3 apart = inVolume / volume.spacing - 0.5f * glm::vec3(volume.counts - 1);
    glm::ivec3 cells = cellsToCentre(volume, camera);
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(apart[axis]) <= 0.5f + deadBand) cells[axis] = 0;
    return cells;
}

VolumeDesc scrolledVolume(const VolumeDesc& volume, glm::ivec3 cells) {
    VolumeDesc moved = volume;
    // In double: a window may go far, and come back to the same place.
    const glm::dvec3 way = glm::dquat(volume.orientation) * (glm::dvec3(cells) * glm::dvec3(volume.spacing));
    moved.origin = glm::vec3(glm::dvec3(volume.origin) + way);
    return moved;
}

std::vector<kernels::Volume> makeVolumes(const FieldDesc& desc) {
    return makeVolumes(desc, std::vector<glm::ivec3>(desc.volumes.size()));
}

std::vector<kernels::Volume> makeVolumes(const FieldDesc& desc, std::span<const glm::ivec3> scrolled) {
    std::vector<kernels::Volume> volumes;
    int firstSlot = 0;
    for (std::size_t i = 0; i < desc.volumes.size(); ++i) {
        const VolumeDesc v = scrolledVolume(desc.volumes[i], scrolled[i]);
        const bool turned = v.orientation != glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
        volumes.push_back({.origin = v.origin,
                           .minSpacing = std::min({v.spacing.x, v.spacing.y, v.spacing.z}),
                           .spacing = v.spacing,
                           .firstSlot = firstSlot,
                           .inverseSpacing = 1.0f / v.spacing,
                           .inverseMaxDistance = 1.0f / visibilityRange(v),
                           .counts = v.counts,
                           .turned = turned ? 1 : 0,
                           .orientation = {v.orientation.x, v.orientation.y, v.orientation.z, v.orientation.w},
                           .phase = scrolledPhase(scrolled[i], v.counts),
                           .maxDistance = visibilityRange(v),
                           .relocated = desc.relocation ? 1 : 0});
        firstSlot += probeCount(v);
    }
    return volumes;
}

}  // namespace probegi
