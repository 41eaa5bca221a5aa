// Closest hits of the rays of all probes. Neighbouring threads take the same ray of neighbouring probes: parallel rays
// from nearby origins meet the same nodes. Hits lie in the order of threads, [ray][task], for shade_probes.comp alone.
// variants: tracers
#include "rays.glsl"
#include "scene_set.glsl"
#include "tasks.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    TracePush push;
};

void main() {
    const uint index = globalIndex();
    Tasks list = Tasks(push.tasks);
    const uint tasks = list.counts.tasks;
    if (index >= tasks * uint(push.rays + push.fixedRayCount)) return;
    const uint task = index % tasks;
    const int ray = int(index / tasks);
    useSceneOnly();
    const vec3 origin = list.at[task].origin;
    Hits(push.hits).at[index] = closestHit(Ray(origin, 0.0, Vec3s(push.directions).at[ray], kNoHitDistance));
}
