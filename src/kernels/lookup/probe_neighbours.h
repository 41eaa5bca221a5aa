// The answer where the eight probes of a cage have too little weight: their neighbours, weighted by distance, facing,
// what their guard says of the way and whether they stand in walls.
#ifndef PROBEGI_KERNELS_PROBE_NEIGHBOURS_H
#define PROBEGI_KERNELS_PROBE_NEIGHBOURS_H

#include "kernels/lookup/probe_query.h"

KERNELS_BEGIN

// Sum of weights below which the cage cannot answer: what is left are probes in walls, or probes whose moments say that
// they do not see the point (eight of them at the floor of the Chebyshev weight sum to 1e-6 at most). Ten times this
// asks twice as often and changes nothing that was measured.
KERNEL_CONST float kDoubtful = 0.0005f;
// Added to lengths, so that a point on a probe does not divide by zero.
KERNEL_CONST float kNoLength = 1e-20f;

// Weight of one neighbour. `outside`: outsideWeight(); `toProbe`: from the point, metres; `visible`: what the
// guard says, 0..1.
KERNEL_FN float neighbourWeight(float outside, vec3 toProbe, vec3 normal, float visible, float minSpacing) {
    const float distance = length(toProbe);
    const float near = minSpacing / (minSpacing + distance);
    const float facing = backfaceWeight(cosineToProbe(dot(toProbe, normal), distance, minSpacing), kRulesMeasured);
    return outside * near * near * near * near * crushWeight(facing * visible);
}

// The neighbours make up the weight that a doubtful cage lacks, so that the answer stays continuous in space. `sum` and
// `weightSum` are the cage's, in the space of decodeToBlendSpace(); `neighbours` and the result are E in W m^-2.
KERNEL_FN vec3 completedByNeighbours(vec3 sum, float weightSum, vec3 neighbours) {
    const vec3 root = (sum + (kDoubtful - weightSum) * sqrt(neighbours * (1.0f / kPi))) / kDoubtful;
    return root * root * kPi;
}

KERNELS_END

#endif
