// The balls for sphere_trace.h, in two clusters.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_SPHERE_TRACE_ACCESS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_SPHERE_TRACE_ACCESS_H

#include "kernels/sdf/cluster.h"

#include "kernels_gpu/shaders/few_solids.h"

KERNELS_BEGIN

KERNEL_FN SdfCluster sdfCluster(int number) {
    SdfCluster cluster;
    cluster.first = kCubes + 2 * number;
    cluster.count = 2;
    cluster.centre = vec3(2.5f * float(2 * number) + 1.25f, 0.0f, 0.0f);
    cluster.radius = 3.3f;
    return cluster;
}

KERNELS_END

#endif
