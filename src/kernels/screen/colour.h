// Linear Rec.709 colours: luminance and sRGB encoding.
#ifndef PROBEGI_KERNELS_COLOUR_H
#define PROBEGI_KERNELS_COLOUR_H

#include "kernels/language.h"

KERNELS_BEGIN

// Relative luminance of linear Rec.709 (ITU-R BT.709-6, section 3.2).
KERNEL_FN float luminance(vec3 c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

// Whether there is any light in it; not a number is none.
KERNEL_FN bool anyPositive(vec3 c) {
    return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f;
}

// The sRGB transfer function (IEC 61966-2-1, section 5.2): linear 0..1 to display 0..1.
KERNEL_FN float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * pow(linear, 1.0f / 2.4f) - 0.055f;
}

// Its inverse (IEC 61966-2-1, section 5.3).
KERNEL_FN float decodeSrgb(float display) {
    return display <= 0.04045f ? display / 12.92f : pow((display + 0.055f) / 1.055f, 2.4f);
}

KERNELS_END

#endif
