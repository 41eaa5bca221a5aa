#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/volume/pool.h"

namespace probegi::vulkan {

/// Layout of an atlas for a pool of probes.
struct PoolShape {
    kernels::PoolTiles tiles{};
    std::uint32_t rows = 1;    ///< of tiles per layer
    std::uint32_t layers = 1;  ///< 0: too many probes for the device's images
};

/// The squarest atlas of one layer, or of several if one would exceed `largestSide` texels. `tile`: side of the larger
/// map with its border, in texels.
PoolShape shapeOfPool(std::size_t slots, std::uint32_t tile, std::uint32_t largestSide, std::uint32_t mostLayers);

/// The most probes that fit into the atlases of a device.
std::size_t mostSlots(std::uint32_t tile, std::uint32_t largestSide, std::uint32_t mostLayers);

}  // namespace probegi::vulkan
