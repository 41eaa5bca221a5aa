// Measures each probe's lag by its fixed rays. One thread per probe.
#include "filter.glsl"
#include "ray_data.glsl"
#include "tasks.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    FilterPush push;
};

ProbeSight sightOfTask(uint task, float farthest) {
    SightSum sum = noSight();
    for (int ray = 0; ray < push.rays; ++ray) {
        const uint at = task * uint(push.rays) + uint(ray);
        if (push.ownRays != 0) {
            const RayDatum d = rayDatumAt(push.rayData, push.ownRays == kOwnRaysPacked, at);
            addOwnRayToSight(sum, d.radiance, d.distance);
        } else {
            const FixedRayDatum d = FixedRays(push.rayData).at[at];
            addToSight(sum, Vec3s(push.directions).at[ray], d.direct, d.bounced, d.distance, farthest);
        }
    }
    return sightOf(sum);
}

void main() {
    const uint index = globalIndex();
    if (index >= Tasks(push.tasks).counts.tasks) return;
    const ProbeTask task = Tasks(push.tasks).at[index];
    const uint probe = task.slot;
    const ProbeSight sight = sightOfTask(index, probegiField.volumes[task.volume].maxDistance);
    ProbeSteps(push.steps).at[probe].sight = sight;
    ProbeSteps(push.steps).at[probe].lag = lagHeard(probeLag(sight, unpackFilter(ProbeFilters(push.filters).at[probe])),
                                                    probegiStates.at[probe].backfaceShare);
}
