#pragma once

#include <glm/vec3.hpp>

namespace probegi {

/// Rec.709, in double precision: measures add up many pixels.
inline double luminance(glm::vec3 rgb) {
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

/// Mean of the channels.
inline double channelMean(glm::vec3 rgb) {
    return (double(rgb.x) + rgb.y + rgb.z) / 3;
}

}  // namespace probegi
