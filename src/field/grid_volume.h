#pragma once

#include <algorithm>

#include "kernels/volume/volume.h"
#include "probegi/grid.h"

namespace probegi {

/// A grid as kernels see it. `maxDistance`: FieldLayout's, metres.
inline kernels::Volume gridVolume(const GridDesc& grid, float maxDistance) {
    kernels::Volume volume{};
    volume.origin = grid.origin;
    volume.minSpacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    volume.spacing = grid.spacing;
    volume.inverseSpacing = 1.0f / grid.spacing;
    volume.inverseMaxDistance = 1.0f / maxDistance;
    volume.counts = grid.counts;
    volume.orientation = {0, 0, 0, 1};
    return volume;
}

}  // namespace probegi
