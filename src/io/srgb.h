#pragma once

#include <cmath>

namespace probegi::io {

/// The sRGB transfer function (IEC 61966-2-1, section 5.2): linear 0..1 to display 0..1.
inline float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// Its inverse (IEC 61966-2-1, section 5.3).
inline float decodeSrgb(float display) {
    return display <= 0.04045f ? display / 12.92f : std::pow((display + 0.055f) / 1.055f, 2.4f);
}

}  // namespace probegi::io
