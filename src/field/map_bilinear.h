#pragma once

#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "kernels/probe/octahedral_texel.h"

namespace probegi {

/// Bilinear in an octahedral map without a border: between the four texels around a direction, what lies across the
/// edges included. `texel` gives the one of an index, row by row.
template <class Texel>
auto bilinearInMap(glm::vec3 direction, int size, const Texel& texel) {
    const glm::vec2 at = kernels::octTexelPosition(kernels::octEncode(direction), size);
    const glm::vec2 corner = glm::clamp(glm::floor(at), glm::vec2(-1.0f), glm::vec2(float(size - 1)));
    const glm::vec2 f = at - corner;
    const auto tap = [&](int x, int y) {
        const glm::ivec2 t = kernels::octWrapTexel(int(corner.x) + x, int(corner.y) + y, size);
        return texel(std::size_t(t.y * size + t.x));
    };
    return (1 - f.x) * (1 - f.y) * tap(0, 0) + f.x * (1 - f.y) * tap(1, 0) + (1 - f.x) * f.y * tap(0, 1) +
           f.x * f.y * tap(1, 1);
}

}  // namespace probegi
