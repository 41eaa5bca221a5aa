// Closest hits of the rays of all tasks. Neighbouring threads take the same ray of neighbouring probes, since parallel
// rays from nearby origins visit the same nodes. Hits are stored in thread order, [ray][task]; only shade_probes.comp
// reads them.
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
