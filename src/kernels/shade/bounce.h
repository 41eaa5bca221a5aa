// The light that a surface sends to a probe: it reflects as Lambert of its base colour.
#ifndef PROBEGI_KERNELS_BOUNCE_H
#define PROBEGI_KERNELS_BOUNCE_H

#include "kernels/language.h"

KERNELS_BEGIN

// Albedo of a surface in the field's bounces is at most this: a closed room of albedo 1 has no steady state.
KERNEL_CONST float kMaxBounceAlbedo = 0.99f;

// Radiance that a surface of the given base colour reflects of the irradiance it receives.
KERNEL_FN vec3 bounceRadiance(vec3 albedo, vec3 irradiance) {
    return min(albedo, vec3(kMaxBounceAlbedo)) * irradiance * (1.0f / kPi);
}

KERNELS_END

#endif
