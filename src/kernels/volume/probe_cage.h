// Which probes stand around a point: the cage of section 2.2, and its neighbours, which answer where the cage does not
// know. A probe's place in the grid is its integer coordinates, x fastest.
#ifndef PROBEGI_KERNELS_PROBE_CAGE_H
#define PROBEGI_KERNELS_PROBE_CAGE_H

#include "kernels/lanes.h"

KERNELS_BEGIN

// Outside the grid the nearest point of it answers: farther away no probe could see the point.
KERNEL_FN Real3 clampToGrid(Real3 position, vec3 origin, vec3 spacing, ivec3 counts) {
    return clamp(position, origin, origin + spacing * vec3(counts - 1));
}

// The place in the grid, in spacings from its origin.
KERNEL_FN Real3 gridCoordinates(Real3 position, vec3 origin, vec3 inverseSpacing) {
    return (position - origin) * inverseSpacing;
}

// The cage's lowest probe, as whole floats.
KERNEL_FN Real3 cageBase(Real3 gridPosition, ivec3 counts) {
    return clamp(floor(gridPosition), vec3(0.0f), vec3(counts - 2));
}

// Where a point lies in its cage, 0..1 an axis.
KERNEL_FN Real3 cageAlpha(Real3 gridPosition, Real3 base) {
    return clamp(gridPosition - base, vec3(0.0f), vec3(1.0f));
}

// The probes around a cage that are asked where it does not know: those that share a face with it, four a side. The
// rest of the 4 x 4 x 4 block was measured to change nothing.
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

KERNEL_FN bool isInGrid(ivec3 cell, ivec3 counts) {
    return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < counts.x && cell.y < counts.y && cell.z < counts.z;
}

KERNEL_FN int probeNumber(ivec3 at, ivec3 counts) {
    return at.x + counts.x * (at.y + counts.y * at.z);
}

KERNEL_FN vec3 probePlace(ivec3 at, vec3 origin, vec3 spacing) {
    return origin + vec3(at) * spacing;
}

KERNELS_END

#endif
