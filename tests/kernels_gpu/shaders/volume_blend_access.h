// Two volumes of the field of lookup_access.h, one of them turned, which may answer around a camera.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_VOLUME_BLEND_ACCESS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_VOLUME_BLEND_ACCESS_H

#include "lookup_access.h"

KERNELS_BEGIN

KERNEL_FN int volumeCount(Access) {
    return 2;
}
KERNEL_FN Volume volumeOfRank(Access, int rank) {
    Volume v;
    v.origin = rank == 0 ? vec3(-1.5f, -1.0f, -2.0f) : vec3(-4.0f, -3.0f, -1.0f);
    v.spacing = rank == 0 ? vec3(0.5f, 0.4f, 0.6f) : vec3(1.2f, 1.0f, 1.1f);
    v.minSpacing = rank == 0 ? 0.4f : 1.0f;
    v.inverseSpacing = vec3(1.0f) / v.spacing;
    v.inverseMaxDistance = 0.4f;
    v.maxDistance = 2.5f;
    v.counts = rank == 0 ? ivec3(7, 6, 8) : ivec3(6, 7, 5);
    v.phase = ivec3(rank, 0, 2);
    v.firstSlot = 400 * rank;
    v.turned = rank;
    v.relocated = rank & 1;
    v.orientation = vec4(0.0f, 0.28f, 0.0f, 0.96f);
    return v;
}
KERNEL_FN bool rankTracksCamera(Access access, int rank) {
    return rank == 0 && access.guard == 1;
}
KERNEL_FN vec3 cameraPosition(Access) {
    return vec3(0.1f, -0.1f, 0.2f);
}
KERNEL_FN bool outsideFades(Access access) {
    return access.walls < 0.5f;
}
KERNEL_FN vec3 outsideRadiance(Access) {
    return vec3(0.5f, 0.25f, 2.0f);
}

KERNELS_END

#endif
