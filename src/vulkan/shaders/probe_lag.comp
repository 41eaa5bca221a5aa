// What the fixed rays of each probe tell of its lag. A thread a probe.
#include "filter.glsl"
#include "ray_data.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    FilterPush push;
};

ProbeSight sightOfProbe(int probe) {
    SightSum sum = noSight();
    for (int ray = 0; ray < push.rays; ++ray) {
        const int at = probe * push.rays + ray;
        if (push.ownRays != 0) {
            const RayDatum d = RayData(push.rayData).at[at];
            addOwnRayToSight(sum, d.radiance, d.distance);
        } else {
            const FixedRayDatum d = FixedRays(push.rayData).at[at];
            addToSight(sum, Vec3s(push.directions).at[ray], d.direct, d.bounced, d.distance, push.maxDistance);
        }
    }
    return sightOf(sum);
}

void main() {
    const int probe = int(globalIndex());
    if (probe >= push.probes) return;
    const ProbeSight sight = sightOfProbe(probe);
    ProbeSteps(push.steps).at[probe].sight = sight;
    ProbeSteps(push.steps).at[probe].lag = lagHeard(probeLag(sight, unpackFilter(ProbeFilters(push.filters).at[probe])),
                                                    probegiStates.backfaceShare[probe]);
}
