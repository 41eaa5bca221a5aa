// Places new probes: all looks of relocation at once, with rays of their own (DDGI paper, sections 5 and 6.3). One work
// group per probe.
// variants: tracers
#include "rays.glsl"
#include "scene_set.glsl"

#include "places.glsl"

#include "kernels/trace/ray_set.h"

shared float distances[kRelocationRays];  // as RayDatum's; kIgnored: the ray met something that moves
shared uint solids[kRelocationRays];
shared uint placementNow;

const float kIgnored = 2e30;

void traceRay(vec3 origin, uint i) {
    const Ray ray = Ray(origin, 0.0, sphericalFibonacci(i, kRelocationRays), kNoHitDistance);
    const Hit hit = closestHit(ray);
    distances[i] = kNoHitDistance;
    solids[i] = 0u;
    if (hit.primitive < 0) return;
    const Surface surface = surfaceAt(ray, hit);
    // Within the bounds of what moves may be static surfaces too, which stay when it goes.
    if (!surface.back) markUsed(surface.position, surface.geometricNormal);
    if (moves(surface.position)) {
        distances[i] = kIgnored;
        return;
    }
    distances[i] = surface.back ? -hit.distance : hit.distance;
    solids[i] = surface.backface ? 1u : 0u;
}

uint lookFrom(Volume v, uint placement) {
    PlaceSight sight = nothingSeen();
    int counted = 0;
    for (uint i = 0u; i < kRelocationRays; ++i) {
        if (distances[i] >= kIgnored) continue;
        ++counted;
        addToPlaceSight(sight, toVolumeDirection(v, sphericalFibonacci(i, kRelocationRays)), distances[i],
                        solids[i] != 0u);
    }
    return lookedAround(v, placement, sight, counted, relocates(), probegiField.rules);
}

void main() {
    const int slot = int(blockIndex());
    if (uint(slot) >= push.slots || !isNewProbe(slot)) return;
    useSceneOnly();
    const Volume v = probegiField.volumes[probegiVolumeOf(slot)];
    const uint thread = gl_LocalInvocationID.x;
    if (thread == 0u) placementNow = beginPlacing(probegiStates.at[slot].placement);
    barrier();
    const uint looks = looksOfPlacement(relocates());
    for (uint look = 0u; look < looks; ++look) {
        const vec3 origin = placedPosition(v, probeCell(v, slot), placementNow);
        for (uint i = thread; i < kRelocationRays; i += gl_WorkGroupSize.x) traceRay(origin, i);
        barrier();
        if (thread == 0u) placementNow = lookFrom(v, placementNow);
        barrier();
    }
    if (thread == 0u) probegiStates.at[slot].placement = placementNow;
}
