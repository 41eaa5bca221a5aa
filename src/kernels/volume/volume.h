// A volume of probes: a lattice of cells that may be turned against the world's axes. This header and volume_frame.h
// alone know which slot of the field's pool a probe has, which cell a slot is, and where a probe stands. One struct for
// C++ and GLSL, scalar layout.
#ifndef PROBEGI_KERNELS_VOLUME_H
#define PROBEGI_KERNELS_VOLUME_H

#include "kernels/language.h"

KERNELS_BEGIN

struct Volume {
    vec3 origin;       // of cell (0, 0, 0), metres, in the world
    float minSpacing;  // metres
    vec3 spacing;      // metres
    int firstSlot;     // of the pool
    vec3 inverseSpacing;
    float inverseMaxDistance;  // 1 / metres
    ivec3 counts;
    int turned;         // 0: along the world's axes, and `orientation` is not looked at
    vec4 orientation;   // unit quaternion (x, y, z, w) from the volume's frame to the world
    ivec3 phase;        // of scrolling, 0..counts-1: where cell (0, 0, 0) lies in the ring of each axis
    float maxDistance;  // metres; farthest distance that visibility distinguishes
    int relocated;      // 0: all probes stand on the lattice, and offsets are not looked at
};

// The ring's place of a cell on one axis, 0 <= cell < count.
KERNEL_FN int ringPlace(int cell, int phase, int count) {
    const int place = cell + phase;
    return place < count ? place : place - count;
}

// Cell -> slot.
KERNEL_FN int probeSlot(Volume v, ivec3 cell) {
    return v.firstSlot + ringPlace(cell.x, v.phase.x, v.counts.x) +
           v.counts.x *
               (ringPlace(cell.y, v.phase.y, v.counts.y) + v.counts.y * ringPlace(cell.z, v.phase.z, v.counts.z));
}

// Slot -> cell.
KERNEL_FN ivec3 probeCell(Volume v, int slot) {
    const int i = slot - v.firstSlot;
    const ivec3 place = ivec3(i % v.counts.x, i / v.counts.x % v.counts.y, i / (v.counts.x * v.counts.y));
    return ivec3(ringPlace(place.x, v.counts.x - v.phase.x, v.counts.x),
                 ringPlace(place.y, v.counts.y - v.phase.y, v.counts.y),
                 ringPlace(place.z, v.counts.z - v.phase.z, v.counts.z));
}

// A probe's number by its cell: the seed of its dither and samples, which depend on no other volume, nor on where a
// scrolled window came from.
KERNEL_FN int probeNumber(Volume v, int slot) {
    const ivec3 cell = probeCell(v, slot);
    return cell.x + v.counts.x * (cell.y + v.counts.y * cell.z);
}

KERNEL_FN int volumeProbes(Volume v) {
    return v.counts.x * v.counts.y * v.counts.z;
}

KERNEL_FN bool isInVolume(Volume v, ivec3 cell) {
    return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < v.counts.x && cell.y < v.counts.y &&
           cell.z < v.counts.z;
}

// Scrolling (section 7.3): the window moves by whole cells. Probes that stay inside keep their slots and all they hold;
// the slots of those that leave go to those that enter on the other side. Whether a cell's probe entered with the last
// step, by `cells`: where the window was before, there was no such cell.
KERNEL_FN bool hasEntered(Volume v, ivec3 cell, ivec3 cells) {
    return !isInVolume(v, cell + cells);
}

// Where the probe of a cell stands, in the volume's frame.
KERNEL_FN vec3 probePlace(Volume v, ivec3 cell) {
    return v.origin + vec3(cell) * v.spacing;
}

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(Volume, spacing) == 16 && offsetof(Volume, counts) == 48 && offsetof(Volume, phase) == 80 &&
              sizeof(Volume) == 100);
}  // namespace probegi::kernels
#endif

#endif
