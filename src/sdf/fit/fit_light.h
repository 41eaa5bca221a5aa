#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "sdf/fit/fit_rays.h"

namespace probegi {

/// Mean light on open ground below a sky of 1, among grey surfaces, about.
constexpr float kOpenLight = 0.6f;

/// The mean light, 0..1, where each ray starts, below an even sky of 1 and among grey surfaces: of the part of space
/// that its start is in. `frame`: as whose axes most walls stand.
std::vector<float> lightOfStarts(std::span<const FitRay> rays, const glm::mat3& frame);

}  // namespace probegi
