// The light that a surface reflects towards a probe: Lambert with its base colour.
#ifndef PROBEGI_KERNELS_BOUNCE_H
#define PROBEGI_KERNELS_BOUNCE_H

#include "kernels/language.h"

KERNELS_BEGIN

// Upper limit for albedo in the field's bounces: a closed room of albedo 1 has no steady state.
KERNEL_CONST float kMaxBounceAlbedo = 0.99f;

// Radiance that a surface of the given base colour reflects.
KERNEL_FN vec3 bounceRadiance(vec3 albedo, vec3 irradiance) {
    return min(albedo, vec3(kMaxBounceAlbedo)) * irradiance * (1.0f / kPi);
}

KERNELS_END

#endif
