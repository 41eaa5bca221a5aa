// From scene-referred light to display codes.
#ifndef PROBEGI_KERNELS_TONE_MAP_H
#define PROBEGI_KERNELS_TONE_MAP_H

#include "kernels/screen/colour.h"

KERNELS_BEGIN

KERNEL_CONST float kShoulderStart = 0.6f;     // below this the filmic curve is the identity
KERNEL_CONST float kDesaturation = 0.15f;     // how fast an overexposed colour turns white
KERNEL_CONST float kDisplayableLimit = 1e6f;  // keeps the curve's arithmetic finite

// Identity up to kShoulderStart, then an exponential approach to 1 with matching value and slope.
KERNEL_FN float filmicShoulder(float value) {
    if (value <= kShoulderStart) return value;
    const float room = 1.0f - kShoulderStart;
    return 1.0f - room * exp((kShoulderStart - value) / room);
}

// The curve acts on the largest component and scales the others with it, which preserves hue (a curve per channel turns
// orange yellow). What the curve removes is added back as white: bright lights desaturate as on film.
KERNEL_FN vec3 filmicCurve(vec3 v) {
    const float peak = max(v.x, max(v.y, v.z));
    if (peak <= kShoulderStart) return v;
    const float mapped = filmicShoulder(peak);
    const float white = 1.0f - 1.0f / (1.0f + kDesaturation * (peak - mapped));
    return mix(v * (mapped / peak), vec3(mapped), white);
}

// NaN becomes black.
KERNEL_FN float displayable(float v) {
    return v > 0.0f ? min(v, kDisplayableLimit) : 0.0f;
}

// Display-referred value in 0..1: exposure, curve, sRGB.
KERNEL_FN vec3 toneMap(vec3 linear, float exposure, bool filmic) {
    vec3 v = linear * exposure;
    v = vec3(displayable(v.x), displayable(v.y), displayable(v.z));
    if (filmic) v = filmicCurve(v);
    v = min(v, vec3(1.0f));
    return vec3(encodeSrgb(v.x), encodeSrgb(v.y), encodeSrgb(v.z));
}

// Added to a value in 8-bit steps before rounding down, 1/128..127/128: the 8 x 8 matrix of Bayer ("An optimum method
// for two-level rendition of continuous-tone pictures", 1973), each of its 64 levels once. Half a level away from 0 and
// 1, so that a value on a step stays there whatever the rounding before. x, y >= 0.
KERNEL_FN float ditherThreshold(int x, int y) {
    const int odd = x ^ y;
    const int level =
        ((odd & 1) << 5) | ((y & 1) << 4) | ((odd & 2) << 2) | ((y & 2) << 1) | ((odd & 4) >> 1) | ((y & 4) >> 2);
    return (float(level) + 0.5f) / 64.0f;
}

// The 8-bit codes of pixel (x, y), with or without dithering.
KERNEL_FN uvec3 displayCodes(vec3 display, bool dither, int x, int y) {
    const float threshold = dither ? ditherThreshold(x, y) : 0.5f;
    return uvec3(display * 255.0f + vec3(threshold));
}

KERNELS_END

#endif
