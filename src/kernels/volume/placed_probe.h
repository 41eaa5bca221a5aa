// Offsets of single probes (probe_offset.h) for those who place them and who start rays from them.
#ifndef PROBEGI_KERNELS_PLACED_PROBE_H
#define PROBEGI_KERNELS_PLACED_PROBE_H

#include "kernels/volume/probe_offset.h"

KERNELS_BEGIN

// One axis of an offset as its byte, rounded to the nearest; `share`: of the spacing, at most kLargestOffset.
KERNEL_FN uint packOffsetAxis(float share) {
    const float steps = floor(share * (127.0f / kLargestOffset) + 0.5f);
    return uint(int(clamp(steps, -127.0f, 127.0f))) & 0xffu;
}

// A placement with another offset, which is given in metres in the volume's frame.
KERNEL_FN uint withOffset(Volume v, uint placement, vec3 offset) {
    const vec3 share = offset * v.inverseSpacing;
    return (placement & 0xffu) | (packOffsetAxis(share.x) << 8u) | (packOffsetAxis(share.y) << 16u) |
           (packOffsetAxis(share.z) << 24u);
}

// Where the probe of a cell stands in the world.
KERNEL_FN vec3 placedPosition(Volume v, ivec3 cell, uint placement) {
    if (v.relocated == 0) return probePosition(v, cell);
    return toWorldDirection(v, vec3(cell) * v.spacing + probeOffset(v, int(placement))) + v.origin;
}

KERNELS_END

#endif
