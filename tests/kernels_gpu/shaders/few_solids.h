// What kernels of the folder sdf find: one scene for all of them, since C++ has one sdfSolid() for all files.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_FEW_SOLIDS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_FEW_SOLIDS_H

#include "kernels/sdf/primitive.h"

KERNELS_BEGIN

KERNEL_CONST int kCubes = 3;

// Three cubes along x, of which the first two touch, and after them four balls.
KERNEL_FN SdfSolid sdfSolid(int number) {
    const bool cube = number < kCubes;
    const float ball = float(number - kCubes);
    SdfSolid solid;
    solid.centre = cube ? vec3(number == 2 ? 3.0f : float(number), 0.0f, 0.0f) : vec3(2.5f * ball, 0.3f * ball, 0.0f);
    solid.shape = cube ? kSdfBox : kSdfSphere;
    solid.rotation = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    solid.halfSize = cube ? vec3(0.5f, 0.5f, 0.5f) : vec3(0.8f, 1.0f, 1.0f);
    solid.rounding = 0.0f;
    return solid;
}

KERNELS_END

#endif
