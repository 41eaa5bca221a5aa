#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/volume/pool.h"

namespace probegi::vulkan {

/// How an atlas for a pool of probes is laid out.
struct PoolShape {
    kernels::PoolTiles tiles{};
    std::uint32_t rows = 1;    ///< of tiles in a layer
    std::uint32_t layers = 1;  ///< 0: the device's images do not hold so many probes
};

/// The squarest atlas of one layer; of several where one would be larger than `largestSide` texels. `tile`: side of the
/// larger map with its border, texels.
PoolShape shapeOfPool(std::size_t slots, std::uint32_t tile, std::uint32_t largestSide, std::uint32_t mostLayers);

/// The most probes that fit into the atlases of a device.
std::size_t mostSlots(std::uint32_t tile, std::uint32_t largestSide, std::uint32_t mostLayers);

}  // namespace probegi::vulkan
