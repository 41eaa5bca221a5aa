#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>

#include "cpu/field_view.h"
#include "kernels/probe/octahedral.h"
#include "kernels/probe/probe_texel.h"

namespace probegi {

/// A bilinear footprint of one map that all probes share: four texel offsets and their weights.
struct Footprint {
    std::array<std::uint32_t, 4> offset;
    std::array<float, 4> weight;
};

inline Footprint footprintOf(const TapTable& table, int size, glm::vec3 direction) {
    const glm::vec2 texel = kernels::octTexelPosition(kernels::octEncode(direction), size);
    const glm::vec2 corner = glm::clamp(glm::floor(texel), glm::vec2(-1.0f), glm::vec2(float(size - 1)));
    const glm::vec2 f = texel - corner;
    const auto& taps = table[std::size_t((int(corner.y) + 1) * (size + 1) + int(corner.x) + 1)];
    return {{taps[0], taps[1], taps[2], taps[3]}, {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
}

/// The four texels around an axis of the world: the axes lie on corners of texels, since maps have an even size.
using AxisTexels = std::array<std::uint16_t, 4>;

/// `axis` 0 to 2, up or down it.
inline const AxisTexels& axisTexels(const TapTable& table, int size, int axis, bool up) {
    const int middle = size / 2, end = up ? size : 0;
    const int x = axis == 0 || (axis == 2 && !up) ? (axis == 0 ? end : size) : middle;
    const int y = axis == 1 || (axis == 2 && !up) ? (axis == 1 ? end : size) : middle;
    return table[std::size_t(y * (size + 1) + x)];
}

/// Moments of distance / maxDistance that the probe of a slot stores at a footprint of the visibility maps.
inline glm::vec2 momentsAt(const FieldView& view, int slot, const Footprint& f) {
    const std::size_t texels = std::size_t(view.visibilityTexels) * std::size_t(view.visibilityTexels);
    const std::uint32_t* map = view.visibility + std::size_t(slot) * texels;
    glm::vec2 moments(0.0f);
    for (std::size_t tap = 0; tap < 4; ++tap) moments += f.weight[tap] * kernels::unpackMoments(map[f.offset[tap]]);
    return moments;
}

}  // namespace probegi
