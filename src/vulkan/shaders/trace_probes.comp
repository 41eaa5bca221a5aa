// Closest hits of the rays of all probes. Neighbouring threads take the same ray of neighbouring probes: parallel rays
// from nearby origins meet the same nodes. Hits lie in the order of threads, [ray][probe], for shade_probes.comp alone.
// variants: tracers
#include "rays.glsl"
#include "scene_set.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    TracePush push;
};

void main() {
    const uint index = globalIndex();
    if (index >= uint(push.probes) * uint(push.rays + push.fixedRayCount)) return;
    const int probe = int(index % uint(push.probes));
    const int ray = int(index / uint(push.probes));
    useSceneOnly();
    const vec3 origin =
        probePlace(gpuProbeCell(probe, probegiVolume.counts), probegiVolume.origin, probegiVolume.spacing);
    Hits(push.hits).at[index] = closestHit(Ray(origin, 0.0, Vec3s(push.directions).at[ray], kNoHitDistance));
}
