// Which probes a look-up at a point of a surface may read: those of its cage, and by the measured rules the layer
// beyond its front (surface_gradient.h). These must be awake.
#ifndef PROBEGI_KERNELS_USED_PROBES_H
#define PROBEGI_KERNELS_USED_PROBES_H

#include "kernels/lookup/access.h"
#include "kernels/volume/probe_cage.h"

KERNELS_BEGIN

// A box of cells, both ends included.
struct UsedProbes {
    ivec3 lowest;
    ivec3 highest;
};

// The cells on one axis. `place`: in spacings; `reach`: how far viewers move the point before its cage is chosen.
KERNEL_FN int lowestUsed(float place, float reach, int count) {
    return int(clamp(floor(place - reach), 0.0f, float(count - 2)));
}
KERNEL_FN int highestUsed(float place, float reach, int count) {
    return int(clamp(floor(place + reach), 0.0f, float(count - 2))) + 1;
}

// `point` and `normal`: in the world, metres and unit. Outside the volume its nearest cell answers, however far.
KERNEL_FN UsedProbes usedProbes(IN(Volume) v, vec3 point, vec3 normal, float tunableBias, int rules) {
    UsedProbes used;
    const vec3 place = gridCoordinates(v, clampToVolume(v, toVolumePoint(v, point)));
    const vec3 facing = toVolumeDirection(v, normal);
    const vec3 reach = length(cageBias(facing, facing, v.minSpacing, tunableBias, rules)) * v.inverseSpacing;
    used.lowest = ivec3(lowestUsed(place.x, reach.x, v.counts.x), lowestUsed(place.y, reach.y, v.counts.y),
                        lowestUsed(place.z, reach.z, v.counts.z));
    used.highest = ivec3(highestUsed(place.x, reach.x, v.counts.x), highestUsed(place.y, reach.y, v.counts.y),
                         highestUsed(place.z, reach.z, v.counts.z));
    if (rules == kRulesPaper) return used;
    const int axis = dominantAxis(facing);
    const ivec3 beyond = ivec3(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
    if (component(axis, facing) > 0.0f)
        used.highest = min(used.highest + beyond, v.counts - 1);
    else
        used.lowest = max(used.lowest - beyond, ivec3(0));
    return used;
}

// How far beyond something that moves the probes are that its surfaces may use: "a probe grid cell + the self-shadow
// bias" (section 6.3), and by the measured rules the layer beyond. Metres along the volume's axes.
KERNEL_FN vec3 moverReach(IN(Volume) v, float tunableBias, int rules) {
    const vec3 axis = vec3(0.0f, 1.0f, 0.0f);
    const float bias = length(visibilityBias(axis, axis, v.minSpacing, tunableBias, rules));
    return (rules == kRulesPaper ? 1.0f : 2.0f) * v.spacing + vec3(bias);
}

// Bounds along the axes of a frame.
struct Box {
    vec3 lower;
    vec3 upper;
};

// Bounds in the world as bounds in the volume's frame.
KERNEL_FN Box boxInVolume(IN(Volume) v, vec3 lower, vec3 upper) {
    Box box;
    box.lower = vec3(1e30f);
    box.upper = vec3(-1e30f);
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 at =
            toVolumePoint(v, vec3((corner & 1) != 0 ? upper.x : lower.x, (corner & 2) != 0 ? upper.y : lower.y,
                                  (corner & 4) != 0 ? upper.z : lower.z));
        box.lower = min(box.lower, at);
        box.upper = max(box.upper, at);
    }
    return box;
}

KERNEL_FN bool holdsPoint(Box box, vec3 point) {
    return point.x >= box.lower.x && point.y >= box.lower.y && point.z >= box.lower.z && point.x <= box.upper.x &&
           point.y <= box.upper.y && point.z <= box.upper.z;
}

// Whether the probe of a cell may be used by surfaces in a box of the volume's frame.
KERNEL_FN bool isNearBox(IN(Volume) v, ivec3 cell, Box box, vec3 reach) {
    box.lower = box.lower - reach;
    box.upper = box.upper + reach;
    return holdsPoint(box, probePlace(v, cell));
}

KERNELS_END

#endif
