// Cells and look-ups are in the volume's frame: the world turned about the volume's origin until the lattice lies along
// the axes. What probes store is by the world's directions, so that all volumes share one set of rays.
#ifndef PROBEGI_KERNELS_VOLUME_FRAME_H
#define PROBEGI_KERNELS_VOLUME_FRAME_H

#include "kernels/lanes.h"
#include "kernels/volume/volume.h"

KERNELS_BEGIN

// v + 2 w (q x v) + 2 q x (q x v): a vector turned by a unit quaternion.
KERNEL_FN Real3 turnedBy(vec3 q, float w, Real3 v) {
    const Real3 t = Real3(v.z * q.y - v.y * q.z, v.x * q.z - v.z * q.x, v.y * q.x - v.x * q.y) * 2.0f;
    return Real3(v.x + t.x * w + (t.z * q.y - t.y * q.z), v.y + t.y * w + (t.x * q.z - t.z * q.x),
                 v.z + t.z * w + (t.y * q.x - t.x * q.y));
}

// Directions and offsets between the world and the volume's frame.
KERNEL_FN Real3 toVolumeDirection(Volume v, Real3 direction) {
    if (v.turned == 0) return direction;
    return turnedBy(vec3(-v.orientation.x, -v.orientation.y, -v.orientation.z), v.orientation.w, direction);
}
KERNEL_FN Real3 toWorldDirection(Volume v, Real3 direction) {
    if (v.turned == 0) return direction;
    return turnedBy(vec3(v.orientation.x, v.orientation.y, v.orientation.z), v.orientation.w, direction);
}

// Points; both frames have the volume's origin in common.
KERNEL_FN Real3 toVolumePoint(Volume v, Real3 point) {
    if (v.turned == 0) return point;
    return toVolumeDirection(v, point - v.origin) + Real3(v.origin);
}

// Where the probe of a cell stands in the world.
KERNEL_FN Real3 probePosition(Volume v, ivec3 cell) {
    return toWorldDirection(v, Real3(vec3(cell) * v.spacing)) + Real3(v.origin);
}

KERNELS_END

#endif
