// Solids of all shapes. Included into the test's own namespace.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_SOME_SOLID_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_SOME_SOLID_H

#include "lane.h"

#include "kernels/sdf/primitive.h"

// Sizes of 0.25 to 1 m, anywhere within 2 m.
KERNEL_FN SdfSolid takeSolid(INOUT(Lane) lane) {
    SdfSolid solid;
    solid.shape = uint(takeIndex(lane, 6));
    solid.centre = takeVector(lane, -2.0f, 2.0f);
    solid.halfSize = takeVector(lane, 0.25f, 1.0f);
    solid.rounding = takeBetween(lane, 0.05f, 0.25f);
    const vec3 axis = takeDirection(lane);
    const float angle = takeBetween(lane, 0.0f, kPi);
    const float s = sin(angle);
    solid.rotation = vec4(axis.x * s, axis.y * s, axis.z * s, cos(angle));
    return solid;
}

#endif
