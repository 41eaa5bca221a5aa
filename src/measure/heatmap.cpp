#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "measure/colour_spaces.h"
#include "probegi/measure.h"

namespace probegi {

namespace {

// A path through CIELAB whose lightness rises in proportion to the value, so that brighter always means worse, also in
// print and for the colour-blind. Hue runs from violet through red to yellow; chroma fades at both ends, where the
// gamut of a screen is narrow.
constexpr float kDarkest = 4;
constexpr float kBrightest = 96;
constexpr float kFirstHue = 300;  ///< degrees
constexpr float kLastHue = 460;   ///< degrees; yellow, a turn further on
constexpr float kChroma = 72;

glm::vec3 mapColour(float value) {
    const float t = std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.0f;
    const float hue = std::lerp(kFirstHue, kLastHue, t) * std::numbers::pi_v<float> / 180;
    const float chroma = kChroma * std::pow(std::sin(std::numbers::pi_v<float> * std::lerp(0.04f, 0.9f, t)), 0.8f);
    const glm::vec3 lab(std::lerp(kDarkest, kBrightest, t), chroma * std::cos(hue), chroma * std::sin(hue));
    const glm::vec3 rgb = colour::rgbFromXyz(colour::xyzFromLab(lab));
    return colour::encodeSrgb(glm::clamp(rgb, 0.0f, 1.0f));
}

}  // namespace

HdrImage heatmap(const HdrImage& values) {
    HdrImage out(values.width, values.height);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        const glm::vec3 v = values.pixels[i];
        out.pixels[i] = mapColour((v.x + v.y + v.z) / 3);
    }
    return out;
}

HdrImage linearFromDisplay(const HdrImage& display) {
    HdrImage out(display.width, display.height);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = colour::decodeSrgb(display.pixels[i]);
    return out;
}

}  // namespace probegi
