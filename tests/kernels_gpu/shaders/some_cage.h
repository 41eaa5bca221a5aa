// A point between probes, far enough from where rounding could choose another cage or axis.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_SOME_CAGE_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_SOME_CAGE_H

#include "some_volume.h"

#include "kernels/lookup/cage.h"

KERNEL_FN Cage takeCage(INOUT(Lane) lane, Volume v) {
    const ivec3 cell = takeCell(lane, v);
    const float tilt = takeBetween(lane, -0.5f, 0.5f);
    const float lean = takeBetween(lane, -0.3f, 0.3f);
    const int axis = takeIndex(lane, 3);
    const float side = takeIndex(lane, 2) == 0 ? -1.0f : 1.0f;
    const vec3 alpha = takeVector(lane, 0.1f, 0.9f);
    Cage cage;
    cage.base = vec3(min(cell, v.counts - ivec3(2)));
    cage.alpha = alpha;
    cage.position = v.origin + (cage.base + alpha) * v.spacing;
    cage.normal =
        normalize(axis == 0 ? vec3(side, tilt, lean) : (axis == 1 ? vec3(lean, side, tilt) : vec3(tilt, lean, side)));
    cage.bias = cage.normal * (0.2f * v.minSpacing);
    return cage;
}

#endif
