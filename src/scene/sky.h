#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "kernels/language.h"
#include "probegi/scene.h"

namespace probegi {

/// Radiance that arrives from the sky along the unit vector `direction` (which points to the sky). Bilinear in the
/// image, wrapping around horizontally.
inline glm::vec3 skyRadiance(const Sky& sky, glm::vec3 direction) {
    if (!sky.textured()) return sky.radiance;
    const int w = sky.image.width, h = sky.image.height;
    const float u = std::atan2(direction.x, -direction.z) / (2 * kernels::kPi) + 0.5f;
    const float v = std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / kernels::kPi;
    const float x = u * float(w) - 0.5f, y = std::clamp(v * float(h) - 0.5f, 0.0f, float(h - 1));
    const int x0 = int(std::floor(x)), y0 = int(y), y1 = std::min(y0 + 1, h - 1);
    const float fx = x - float(x0), fy = y - float(y0);
    const int xa = (x0 + w) % w, xb = (x0 + 1) % w;
    const auto& image = sky.image;
    return sky.radiance * glm::mix(glm::mix(image.at(xa, y0), image.at(xb, y0), fx),
                                   glm::mix(image.at(xa, y1), image.at(xb, y1), fx), fy);
}

}  // namespace probegi
