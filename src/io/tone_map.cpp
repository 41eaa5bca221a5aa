#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "io/srgb.h"
#include "probegi/image.h"

namespace probegi {

namespace {

constexpr float kShoulderStart = 0.6f;  ///< below this the filmic curve is the identity
constexpr float kDesaturation = 0.15f;  ///< how fast an overexposed colour turns white

/// Identity up to kShoulderStart, then an exponential approach to 1 with the same value and slope where they meet.
float shoulder(float value) {
    if (value <= kShoulderStart) return value;
    constexpr float kRoom = 1.0f - kShoulderStart;
    return 1.0f - kRoom * std::exp(-(value - kShoulderStart) / kRoom);
}

/// The curve acts on the largest component and scales the others with it, so hues hold (a curve per channel turns
/// orange yellow). What the curve takes away is given back as white: bright lights bleach as they do on film.
glm::vec3 filmicCurve(glm::vec3 v) {
    const float peak = std::max({v.x, v.y, v.z});
    if (peak <= kShoulderStart) return v;
    const float mapped = shoulder(peak);
    const float white = 1.0f - 1.0f / (1.0f + kDesaturation * (peak - mapped));
    return glm::mix(v * (mapped / peak), glm::vec3(mapped), white);
}

/// Not a number becomes black; the upper limit keeps the curve's arithmetic finite.
float displayable(float v) {
    constexpr float kLimit = 1e6f;
    return v > 0.0f ? std::min(v, kLimit) : 0.0f;
}

}  // namespace

glm::vec3 toDisplay(glm::vec3 linear, const ToneMap& toneMap) {
    glm::vec3 v = linear * toneMap.exposure;
    v = {displayable(v.x), displayable(v.y), displayable(v.z)};
    if (toneMap.filmic) v = filmicCurve(v);
    v = glm::min(v, glm::vec3(1.0f));
    return {io::encodeSrgb(v.x), io::encodeSrgb(v.y), io::encodeSrgb(v.z)};
}

}  // namespace probegi
