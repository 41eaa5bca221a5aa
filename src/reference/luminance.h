#pragma once

#include <glm/vec3.hpp>

namespace probegi {

/// Relative luminance of linear Rec.709.
inline float luminance(glm::vec3 c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

}  // namespace probegi
