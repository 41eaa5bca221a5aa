// What the rays of all probes bring home: sky, emission, punctual lights with shadow rays, and the light of earlier
// bounces from last frame's field (DDGI paper, section 2.3).
// variants: bvh=TRACER_BVH ray_query=TRACER_RAY_QUERY
#include "direct_light.glsl"
#include "ray_data.glsl"
#include "rays.glsl"
#include "volume.glsl"

#include "kernels/bounce.h"
#include "kernels/probe_blend.h"

layout(push_constant, scalar) uniform Push {
    TracePush push;
};

vec3 lambertIrradiance(Surface surface, vec3 toViewer) {
    vec3 e = vec3(0.0);
    if (push.bounces != 0) e = probegiIrradiance(surface.position, surface.shadingNormal, toViewer);
    for (int i = 0; i < PROBEGI_SCENE.lightCount; ++i) {
        const LightSample light = lightSampleAt(i, surface.position);
        e += visibleLight(surface, light) * max(dot(light.toLight, surface.shadingNormal), 0.0);
    }
    return e;
}

RayDatum shade(Ray ray, Hit hit) {
    if (hit.primitive < 0) return RayDatum(skyRadianceAt(ray.direction), kNoHitDistance);
    const Surface surface = surfaceAt(ray, hit);
    if (surface.backface) return RayDatum(vec3(0.0), -hit.distance);
    const vec3 e = lambertIrradiance(surface, -ray.direction);
    const vec3 radiance = surface.emission + bounceRadiance(surface.albedo, e);
    return surface.back ? RayDatum(radianceFromBack(radiance), -hit.distance) : RayDatum(radiance, hit.distance);
}

void main() {
    const uint index = globalIndex();
    if (index >= uint(push.probes) * uint(push.rays)) return;
    const int probe = int(index % uint(push.probes));
    const int rayIndex = int(index / uint(push.probes));
    useLighting(push.lighting);
    const vec3 origin =
        probePlace(gpuProbeCell(probe, probegiVolume.counts), probegiVolume.origin, probegiVolume.spacing);
    const Ray ray = Ray(origin, 0.0, Vec3s(push.directions).at[rayIndex], kNoHitDistance);
    RayData(push.rayData).at[probe * push.rays + rayIndex] = shade(ray, Hits(push.hits).at[index]);
}
