#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "sdf/fit/fit_rays.h"

namespace probegi {

/// The ways in which a scene's surfaces stand: columns are the axes of a frame. The first is that of most walls and
/// floors, with axes as near as can be to the world's; each further one has the slope of other flat surfaces, roofs
/// say, as one of its axes. At most `most`.
std::vector<glm::mat3> findFrames(std::span<const FitSurface> surfaces, int most);

/// Whether a surface faces along an axis of the frame, forwards or backwards.
bool facesAlong(const glm::mat3& frame, glm::vec3 normal) noexcept;

}  // namespace probegi
