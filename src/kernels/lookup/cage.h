// A point to be looked up as the volume's probes see it.
#ifndef PROBEGI_KERNELS_CAGE_H
#define PROBEGI_KERNELS_CAGE_H

#include "kernels/lookup/probe_query.h"
#include "kernels/volume/probe_cage.h"
#include "kernels/volume/volume_frame.h"

KERNELS_BEGIN

// All in the volume's frame.
struct Cage {
    Real3 position;  // of the point, moved into the volume
    Real3 normal;
    Real3 bias;   // from the point to where visibility is tested
    Real3 base;   // the lowest of the eight probes' cells, as whole floats
    Real3 alpha;  // where between them the point lies, 0..1 an axis
};

// `point`, `normal` and `toViewer`: in the world, metres and unit.
KERNEL_FN Cage cageAround(IN(Volume) v, Real3 point, Real3 normal, Real3 toViewer, float tunableBias, int rules) {
    Cage cage;
    cage.normal = toVolumeDirection(v, normal);
    const Real3 viewer = viewerOf(toVolumeDirection(v, toViewer), cage.normal);
    cage.position = clampToVolume(v, toVolumePoint(v, point));
    cage.bias = visibilityBias(cage.normal, viewer, v.minSpacing, tunableBias, rules);
    // The cage and the trilinear weights belong to a point a little off the surface: on a wall that runs through a
    // layer of probes the answer would otherwise lean on that layer alone.
    const Real3 local =
        gridCoordinates(v, cage.position + cageBias(cage.normal, viewer, v.minSpacing, tunableBias, rules));
    cage.base = cageBase(v, local);
    cage.alpha = cageAlpha(local, cage.base);
    return cage;
}

KERNELS_END

#endif
