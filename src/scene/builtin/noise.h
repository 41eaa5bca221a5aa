#pragma once

#include <cmath>

#include "kernels/random.h"

/// Tileable value noise from hashes: deterministic, without state.
namespace probegi::builtin {

inline float hash01(int x, int y, int seed) {
    const kernels::uint h =
        kernels::hashCombine(kernels::hashCombine(kernels::uint(x), kernels::uint(y)), kernels::uint(seed));
    return kernels::uintToUnit(h);
}

/// 0..1 at (u, v), with period 1; `cells` lattice cells per period.
inline float valueNoise(float u, float v, int cells, int seed) {
    const float x = (u - std::floor(u)) * float(cells), y = (v - std::floor(v)) * float(cells);
    const int x0 = int(x), y0 = int(y);
    const float fx = x - float(x0), fy = y - float(y0);
    const float sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
    const auto at = [&](int dx, int dy) { return hash01((x0 + dx) % cells, (y0 + dy) % cells, seed); };
    const float bottom = at(0, 0) + (at(1, 0) - at(0, 0)) * sx;
    const float top = at(0, 1) + (at(1, 1) - at(0, 1)) * sx;
    return bottom + (top - bottom) * sy;
}

/// Sum of octaves, 0..1 with mean 0.5.
inline float fractalNoise(float u, float v, int cells, int octaves, int seed) {
    float sum = 0, weight = 0.5f, total = 0;
    for (int o = 0; o < octaves; ++o) {
        sum += weight * valueNoise(u, v, cells << o, seed + o);
        total += weight;
        weight *= 0.5f;
    }
    return sum / total;
}

}  // namespace probegi::builtin
