// Balls for sphere_trace.h, in two clusters.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_SPHERE_TRACE_ACCESS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_SPHERE_TRACE_ACCESS_H

#include "kernels/sdf/cluster.h"

KERNELS_BEGIN

KERNEL_FN SdfSolid sdfSolid(int number) {
    SdfSolid solid;
    solid.centre = vec3(2.5f * float(number), 0.3f * float(number), 0.0f);
    solid.shape = kSdfSphere;
    solid.rotation = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    solid.halfSize = vec3(0.8f, 1.0f, 1.0f);
    solid.rounding = 0.0f;
    return solid;
}

KERNEL_FN SdfCluster sdfCluster(int number) {
    SdfCluster cluster;
    cluster.first = 2 * number;
    cluster.count = 2;
    cluster.centre = vec3(2.5f * float(2 * number) + 1.25f, 0.0f, 0.0f);
    cluster.radius = 3.3f;
    return cluster;
}

KERNELS_END

#endif
