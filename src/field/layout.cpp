#include "field/layout.h"

#include <algorithm>
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

std::vector<kernels::Volume> makeVolumes(const FieldDesc& desc) {
    std::vector<kernels::Volume> volumes;
    int firstSlot = 0;
    for (const VolumeDesc& v : desc.volumes) {
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
                           .phase = glm::ivec3(0),
                           .maxDistance = visibilityRange(v)});
        firstSlot += probeCount(v);
    }
    return volumes;
}

}  // namespace probegi
