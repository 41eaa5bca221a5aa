// Volumes of all kinds, turned and scrolled or not. Included into the test's own namespace.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_SOME_VOLUME_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_SOME_VOLUME_H

#include "lane.h"

#include "kernels/volume/volume.h"

KERNEL_FN Volume takeVolume(INOUT(Lane) lane) {
    Volume v;
    v.origin = takeVector(lane, -5.0f, 5.0f);
    v.spacing = takeVector(lane, 0.5f, 2.0f);
    v.minSpacing = min(v.spacing.x, min(v.spacing.y, v.spacing.z));
    v.inverseSpacing = vec3(1.0f) / v.spacing;
    v.inverseMaxDistance = 0.4f;
    const int x = 3 + takeIndex(lane, 5);
    const int y = 3 + takeIndex(lane, 5);
    const int z = 3 + takeIndex(lane, 5);
    v.counts = ivec3(x, y, z);
    const int phaseX = takeIndex(lane, x);
    const int phaseY = takeIndex(lane, y);
    const int phaseZ = takeIndex(lane, z);
    v.phase = ivec3(phaseX, phaseY, phaseZ);
    v.firstSlot = 1000 * takeIndex(lane, 3);
    v.turned = takeIndex(lane, 2);
    v.relocated = takeIndex(lane, 2);
    const vec3 axis = takeDirection(lane);
    const float half_ = takeBetween(lane, -1.5f, 1.5f);
    const float s = sin(half_);
    v.orientation = vec4(axis.x * s, axis.y * s, axis.z * s, cos(half_));
    return v;
}

// A cell of the volume.
KERNEL_FN ivec3 takeCell(INOUT(Lane) lane, Volume v) {
    const int x = takeIndex(lane, v.counts.x);
    const int y = takeIndex(lane, v.counts.y);
    const int z = takeIndex(lane, v.counts.z);
    return ivec3(x, y, z);
}

KERNEL_FN void giveCell(INOUT(Lane) lane, ivec3 cell) {
    giveBits(lane, uint(cell.x + 64));
    giveBits(lane, uint(cell.y + 64));
    giveBits(lane, uint(cell.z + 64));
}

#endif
