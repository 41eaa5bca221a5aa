// 16-bit storage with dithered rounding. Near its limit, a slow average (hysteresis 0.97) moves by less than half a
// storage step per frame; rounding to nearest would stall it. Rounding up with a probability equal to the fraction
// keeps the expected value exact.
#ifndef PROBEGI_KERNELS_STORAGE_H
#define PROBEGI_KERNELS_STORAGE_H

#include "kernels/random.h"

KERNELS_BEGIN

// Largest finite half float.
KERNEL_CONST float kHalfMax = 65504.0f;

// Float in [0, kHalfMax] -> half float bits; `dither` in 0..8191 decides the rounding of the 13 dropped bits. Below the
// smallest normal half (6.1e-5) the result is 0.
KERNEL_FN uint packHalfDithered(float x, uint dither) {
    const uint bits = floatBitsToUint(min(x, kHalfMax)) + dither;
    const uint h = min(bits >> 13u, 0x23bffu);  // 0x23bff: the largest finite half, before the exponent is rebased
    return h < 0x1c400u ? 0u : h - 0x1c000u;    // 112 << 10: difference of the exponent biases
}

// 2^112: difference of the exponent biases of half and float.
KERNEL_CONST float kHalfRebase = 5.192296858534828e33f;

// Half float bits (non-negative, finite) -> float.
KERNEL_FN float unpackHalf(uint h) {
    return uintBitsToFloat(h << 13u) * kHalfRebase;
}

// Value in [0, 1] -> 16 bits; `dither` in [0, 1) decides the rounding.
KERNEL_FN uint packUnorm16Dithered(float x, float dither) {
    return uint(min(clamp(x, 0.0f, 1.0f) * 65535.0f + dither, 65535.0f));
}

KERNEL_FN float unpackUnorm16(uint u) {
    return float(u) * (1.0f / 65535.0f);
}

// 32 random bits per stored texel and frame.
KERNEL_FN uint storageDither(uint frameSeed, uint texel) {
    return hashUint(frameSeed + texel * 0x9e3779b9u);
}

KERNELS_END

#endif
