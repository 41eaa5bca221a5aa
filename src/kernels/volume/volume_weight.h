// How far a volume answers at a point (section 7.4), and how far any volume does. Lengths here are in cells of the
// volume, so that a fine volume hands over to a coarse one within a cell of its own.
#ifndef PROBEGI_KERNELS_VOLUME_WEIGHT_H
#define PROBEGI_KERNELS_VOLUME_WEIGHT_H

#include "kernels/volume/probe_cage.h"
#include "kernels/volume/volume_frame.h"

KERNELS_BEGIN

// How far in front of a volume's faces its nearest probes still know the light, in cells; one cell farther they know
// nothing. Half a cell is what the tool's warning about surfaces beyond a grid takes for harmless, too.
KERNEL_CONST float kCoveredBeyond = 0.5f;

// Cells from the faces of a box inwards, on the axis where that is least; negative: outside. All in cells: the point,
// the box's middle, and half its sides. The least of the axes, not their product: so the weight falls as slowly in
// corners as at faces, whatever the way a camera takes.
KERNEL_FN float cellsInBox(vec3 point, vec3 middle, vec3 reach) {
    const vec3 inside = reach - abs(point - middle);
    return min(inside.x, min(inside.y, inside.z));
}

// Cells from the outermost probes inwards; `point`: in the world.
KERNEL_FN float cellsInVolume(IN(Volume) v, vec3 point) {
    const vec3 reach = vec3(v.counts - 1) * 0.5f;
    return cellsInBox(gridCoordinates(v, toVolumePoint(v, point)), reach, reach);
}

// The same for a volume that scrolls after a camera: it answers in a box around the camera itself that is one cell
// smaller on each side. The box moves as the camera does, where the window leaps, and a layer of probes that has just
// entered lies outside it. Beyond the window it never reaches, even where nobody scrolled that.
KERNEL_FN float cellsInTrackingVolume(IN(Volume) v, vec3 point, vec3 camera) {
    const vec3 reach = vec3(v.counts - 1) * 0.5f;
    const vec3 at = gridCoordinates(v, toVolumePoint(v, point));
    const vec3 middle = gridCoordinates(v, toVolumePoint(v, camera));
    return min(cellsInBox(at, reach, reach), cellsInBox(at, middle, reach - 1.0f));
}

// Weight of a volume in the blend, from its cells: 1 inside, falling to 0 over the last cell.
KERNEL_FN float volumeWeight(float cells) {
    return clamp(cells, 0.0f, 1.0f);
}

// How far a volume knows the light at a point, from its cells: 1 inside and a little beyond, then falling to 0 over a
// cell.
KERNEL_FN float volumeCoverage(float cells) {
    return clamp(cells + kCoveredBeyond + 1.0f, 0.0f, 1.0f);
}

// E in W m^-2 where the volumes cover a point in part; the rest comes from outside, the same from all sides.
KERNEL_FN vec3 withOutside(vec3 irradiance, float coverage, vec3 outsideRadiance) {
    return irradiance * coverage + outsideRadiance * (kPi * (1.0f - coverage));
}

KERNELS_END

#endif
