// What the probes of a cage store, summed by the weights of cage_weights.h.
#ifndef PROBEGI_KERNELS_GATHER_H
#define PROBEGI_KERNELS_GATHER_H

#include "kernels/lookup/cage_weights.h"
#include "kernels/probe/irradiance_decoding.h"

KERNELS_BEGIN

// In the space of decodeToBlendSpace().
struct CageLight {
    vec3 root;  // sum over the probes
    vec3 rise;  // sum over the pairs of what the probe beyond has more
};

LOOKUP_FN vec3 storedRoot(IN(Access) access, int slot, OF_ACCESS(MapPoint) at) {
    const vec3 stored = storedIrradiance(access, slot, at);
    return vec3(decodeToBlendSpace(stored.x), decodeToBlendSpace(stored.y), decodeToBlendSpace(stored.z));
}

// Weight of the pair in front of which a corner stands; 0: it is not in front.
KERNEL_FN float pairOfCorner(IN(CageWeights) w, int corner) {
    const int x = corner & 1;
    const int y = (corner >> 1) & 1;
    const int z = corner >> 2;
    if (w.axis == 0) return x == w.up ? w.pair[corner >> 1] : 0.0f;
    if (w.axis == 1) return y == w.up ? w.pair[x + 2 * z] : 0.0f;
    return z == w.up ? w.pair[corner & 3] : 0.0f;
}

// `at`: irradiancePoint() of the normal.
LOOKUP_FN CageLight gatherLight(IN(Access) access, IN(CageWeights) w, OF_ACCESS(MapPoint) at) {
    CageLight light;
    light.root = vec3(0.0f);
    light.rise = vec3(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 root = storedRoot(access, w.slot[corner], at);
        light.root += w.weight[corner] * root;
        const float pair = pairOfCorner(w, corner);
        if (pair > 0.0f) light.rise += pair * (storedRoot(access, w.slot[corner] + w.step, at) - root);
    }
    return light;
}

KERNELS_END

#endif
