// The perceptual encoding of stored irradiance (DDGI paper, section 4.2, Listing 1): stored = mean^(1/5).
#ifndef PROBEGI_KERNELS_IRRADIANCE_ENCODING_H
#define PROBEGI_KERNELS_IRRADIANCE_ENCODING_H

#include "kernels/probe/irradiance_decoding.h"

KERNELS_BEGIN

// x^(1/5) for 0 <= x < 1e30, relative error below 3e-7; 0 below 1e-30. An initial guess from the exponent bits, then
// three Newton steps for y^5 = x (each leaves about twice the square of the relative error): the same on every backend,
// and vectorisable.
KERNEL_FN float encodeIrradiance(float x) {
    const float safe = max(x, 1e-30f);
    float y = uintBitsToFloat(floatBitsToUint(safe) / 5u + 852282573u);
    for (int i = 0; i < 3; ++i) {
        const float y2 = y * y;
        y = 0.8f * y + 0.2f * safe / (y2 * y2);
    }
    return select(x < 1e-30f, 0.0f, y);
}

KERNELS_END

#endif
