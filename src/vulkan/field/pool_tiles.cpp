#include "vulkan/field/pool_tiles.h"

#include <bit>

namespace probegi::vulkan {

namespace {

// log2 of the number of tiles along the side of the largest layer.
int largestShift(std::uint32_t tile, std::uint32_t largestSide) {
    return int(std::bit_width(largestSide / tile)) - 1;
}

}  // namespace

PoolShape shapeOfPool(std::size_t slots, std::uint32_t tile, std::uint32_t largestSide, std::uint32_t mostLayers) {
    const int most = largestShift(tile, largestSide);
    PoolShape shape;
    while (shape.tiles.rowShift < most && (std::size_t(1) << (2 * shape.tiles.rowShift)) < slots)
        ++shape.tiles.rowShift;
    const std::size_t row = std::size_t(1) << shape.tiles.rowShift;
    shape.tiles.layerShift = 2 * shape.tiles.rowShift;
    const std::size_t layer = row * row, layers = (slots + layer - 1) / layer;
    shape.layers = layers <= mostLayers ? std::uint32_t(layers) : 0;
    shape.rows = std::uint32_t(layers > 1 ? row : (slots + row - 1) / row);
    return shape;
}

std::size_t mostSlots(std::uint32_t tile, std::uint32_t largestSide, std::uint32_t mostLayers) {
    return (std::size_t(1) << (2 * largestShift(tile, largestSide))) * mostLayers;
}

}  // namespace probegi::vulkan
