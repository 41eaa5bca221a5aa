// Which probes stand around a point: the cage of section 2.2, and its neighbours, which answer where the cage has too
// little weight. All in the volume's frame; a cell is a probe's integer coordinates in the grid.
#ifndef PROBEGI_KERNELS_PROBE_CAGE_H
#define PROBEGI_KERNELS_PROBE_CAGE_H

#include "kernels/lanes.h"
#include "kernels/volume/volume.h"

KERNELS_BEGIN

// Outside the volume the nearest point of it answers: farther away no probe could see the point.
KERNEL_FN Real3 clampToVolume(IN(Volume) v, Real3 position) {
    return clamp(position, v.origin, v.origin + v.spacing * vec3(v.counts - 1));
}

// The place in the grid, in spacings from its origin.
KERNEL_FN Real3 gridCoordinates(IN(Volume) v, Real3 position) {
    return (position - v.origin) * v.inverseSpacing;
}

// The cage's lowest probe, as whole floats.
KERNEL_FN Real3 cageBase(IN(Volume) v, Real3 gridPosition) {
    return clamp(floor(gridPosition), vec3(0.0f), vec3(v.counts - 2));
}

// Where a point lies in its cage, 0..1 an axis.
KERNEL_FN Real3 cageAlpha(Real3 gridPosition, Real3 base) {
    return clamp(gridPosition - base, vec3(0.0f), vec3(1.0f));
}

// The slots of a cage's probes: each axis has two places in its ring, and scrolling may put them at the ring's two
// ends.
struct CageSlots {
    Int x[2];
    Int y[2];
    Int z[2];
};

// Where a cell lies in the ring of one axis, in slots; 0 <= cell < count. `stride`: slots from place to place.
KERNEL_FN Int ringOffset(Int cell, Int phase, Int count, Int stride) {
    const Int place = cell + phase;
    return select(place < count, place, place - count) * stride;
}

// The next cell of that axis; `ring`: slots all around.
KERNEL_FN Int nextInRing(Int offset, int stride, int ring) {
    const Int next = offset + stride;
    return select(next < ring, next, next - ring);
}

// `base`: cageBase().
KERNEL_FN CageSlots cageSlots(IN(Volume) v, Real3 base) {
    const int strideZ = v.counts.x * v.counts.y;
    CageSlots slots;
    slots.x[0] = ringOffset(toInt(base.x), v.phase.x, v.counts.x, 1);
    slots.y[0] = ringOffset(toInt(base.y), v.phase.y, v.counts.y, v.counts.x);
    slots.z[0] = ringOffset(toInt(base.z), v.phase.z, v.counts.z, strideZ);
    slots.x[1] = nextInRing(slots.x[0], 1, v.counts.x);
    slots.y[1] = nextInRing(slots.y[0], v.counts.x, strideZ);
    slots.z[1] = nextInRing(slots.z[0], strideZ, strideZ * v.counts.z);
    return slots;
}

// Slot of one corner: bits 0 to 2 of `corner` are x, y and z.
KERNEL_FN Int cornerSlot(IN(Volume) v, IN(CageSlots) slots, int corner) {
    return slots.x[corner & 1] + slots.y[(corner >> 1) & 1] + slots.z[corner >> 2] + v.firstSlot;
}

// The probes around a cage that are asked where it has too little weight: those that share a face with it, four a side.
// The rest of the 4 x 4 x 4 block was measured to change nothing.
KERNEL_CONST int kNeighbours = 24;

// Place in the grid of the i-th neighbour of the cage with the lowest probe `base`; it may lie outside the grid.
KERNEL_FN ivec3 neighbourCell(ivec3 base, int i) {
    const int axis = i >> 3;
    const int along = (i & 4) != 0 ? 2 : -1;
    const int u = i & 1;
    const int v = (i >> 1) & 1;
    if (axis == 0) return base + ivec3(along, u, v);
    if (axis == 1) return base + ivec3(v, along, u);
    return base + ivec3(u, v, along);
}

KERNELS_END

#endif
