// Three cubes along x for exact_hit.h, of which the first two touch.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_EXACT_HIT_ACCESS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_EXACT_HIT_ACCESS_H

#include "kernels/sdf/primitive.h"

KERNELS_BEGIN

KERNEL_FN SdfSolid sdfSolid(int number) {
    SdfSolid solid;
    solid.centre = vec3(number == 2 ? 3.0f : float(number), 0.0f, 0.0f);
    solid.shape = kSdfBox;
    solid.rotation = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    solid.halfSize = vec3(0.5f, 0.5f, 0.5f);
    solid.rounding = 0.0f;
    return solid;
}

KERNELS_END

#endif
