// Decoding stored irradiance (DDGI paper, section 4.2, Listing 2).
#ifndef PROBEGI_KERNELS_IRRADIANCE_DECODING_H
#define PROBEGI_KERNELS_IRRADIANCE_DECODING_H

#include "kernels/lanes.h"

KERNELS_BEGIN

// Stored value -> linear mean radiance.
KERNEL_FN Real decodeIrradiance(Real stored) {
    const Real s2 = stored * stored;
    return s2 * s2 * stored;
}

// Stored value -> the space with exponent 2 in which a cage's probes are interpolated: stored^(5/2), without pow.
KERNEL_FN Real decodeToBlendSpace(Real stored) {
    return stored * stored * sqrt(stored);
}

KERNELS_END

#endif
