// Which probes stand around a point: the cage of section 2.2, and the wider block that is searched where the cage does
// not know. A probe's place in the grid is its integer coordinates, x fastest.
#ifndef PROBEGI_KERNELS_PROBE_CAGE_H
#define PROBEGI_KERNELS_PROBE_CAGE_H

#include "kernels/language.h"

KERNELS_BEGIN

// Half the side, in probes, of the block that is searched where the cage does not know.
KERNEL_CONST int kSearch = 2;

// Outside the grid the nearest point of it answers: farther away no probe could see the point.
KERNEL_FN vec3 clampToGrid(vec3 position, vec3 origin, vec3 spacing, ivec3 counts) {
    return clamp(position, origin, origin + spacing * vec3(counts - 1));
}

// The place in the grid, in spacings from its origin.
KERNEL_FN vec3 gridCoordinates(vec3 position, vec3 origin, vec3 inverseSpacing) {
    return (position - origin) * inverseSpacing;
}

// The cage's lowest probe, as whole floats.
KERNEL_FN vec3 cageBase(vec3 gridPosition, ivec3 counts) {
    return clamp(floor(gridPosition), vec3(0.0f), vec3(counts - 2));
}

// Where a point lies in its cage, 0..1 an axis.
KERNEL_FN vec3 cageAlpha(vec3 gridPosition, vec3 base) {
    return clamp(gridPosition - base, vec3(0.0f), vec3(1.0f));
}

// First and last probe of the block around a point's cage.
KERNEL_FN ivec3 searchLowest(vec3 gridPosition, ivec3 counts) {
    return clamp(ivec3(cageBase(gridPosition, counts)) - ivec3(kSearch - 1), ivec3(0), counts - 1);
}
KERNEL_FN ivec3 searchHighest(vec3 gridPosition, ivec3 counts) {
    return clamp(ivec3(cageBase(gridPosition, counts)) + ivec3(kSearch), ivec3(0), counts - 1);
}

KERNEL_FN int probeNumber(ivec3 at, ivec3 counts) {
    return at.x + counts.x * (at.y + counts.y * at.z);
}

KERNEL_FN vec3 probePlace(ivec3 at, vec3 origin, vec3 spacing) {
    return origin + vec3(at) * spacing;
}

KERNELS_END

#endif
