// Light along the rays of the tasks: sky, emission, punctual lights with shadow rays, and the light of earlier
// bounces, from the field of the last frame (DDGI paper, section 2.3).
// variants: tracers
#include "direct_light.glsl"
#include "ray_data.glsl"
#include "rays.glsl"
#include "tasks.glsl"
#include "volume.glsl"

#include "kernels/blend/probe_blend.h"
#include "kernels/light/emitter_sampling.h"
#include "kernels/screen/colour.h"
#include "kernels/shade/bounce.h"

layout(push_constant, scalar) uniform Push {
    TracePush push;
};

// Light along a ray: `direct` from lights, emission and sky, `bounced` from the field.
struct RayLight {
    vec3 direct;
    vec3 bounced;
    float distance;  // metres; negative: minus the distance to a backface
    bool back;       // hit the back of a double-sided surface
};

RayDatum datumOf(RayLight light) {
    const vec3 radiance = light.direct + light.bounced;
    return light.back ? RayDatum(radianceFromBack(radiance), -light.distance) : RayDatum(radiance, light.distance);
}

vec3 punctualIrradiance(Surface surface) {
    vec3 e = vec3(0.0);
    for (int i = 0; i < PROBEGI_SCENE.lightCount; ++i) {
        const LightSample light = lightSampleAt(i, surface.position);
        e += visibleLight(surface, light) * max(dot(light.toLight, surface.shadingNormal), 0.0);
    }
    return e;
}

// Weight of an emission for the ray that hit it; emitter samples contribute the rest. Fixed rays get the full emission.
float rayShare(Surface surface, float distance, bool isFixed) {
    if (push.looks == 0 || isFixed) return 1.0;
    return rayEmissionShare(push.rays, push.looks, emitterPerArea(surface.material), distance);
}

RayLight shade(Ray ray, Hit hit, bool isFixed) {
    if (hit.primitive < 0) return RayLight(skyRadianceAt(ray.direction), vec3(0.0), kNoHitDistance, false);
    const Surface surface = surfaceAt(ray, hit);
    if (surface.backface) return RayLight(vec3(0.0), vec3(0.0), -hit.distance, false);
    vec3 bounced = vec3(0.0);
    if (push.bounces != 0) bounced = probegiIrradiance(surface.position, surface.shadingNormal, -ray.direction);
    return RayLight(rayShare(surface, hit.distance, isFixed) * surface.emission +
                        bounceRadiance(surface.albedo, punctualIrradiance(surface)),
                    bounceRadiance(surface.albedo, bounced), hit.distance, surface.back);
}

void main() {
    const uint index = globalIndex();
    Tasks list = Tasks(push.tasks);
    const uint tasks = list.counts.tasks;
    if (index >= tasks * uint(push.rays + push.fixedRayCount)) return;
    const int task = int(index % tasks);
    const int rayIndex = int(index / tasks);
    useLighting(push.lighting);
    const Ray ray = Ray(list.at[task].origin, 0.0, Vec3s(push.directions).at[rayIndex], kNoHitDistance);
    const RayLight light = shade(ray, Hits(push.hits).at[index], rayIndex >= push.rays);
    if (rayIndex < push.rays)
        RayData(push.rayData).at[task * push.rays + rayIndex] = datumOf(light);
    else
        FixedRays(push.fixedRays).at[task * push.fixedRayCount + rayIndex - push.rays] = FixedRayDatum(
            luminance(light.direct), luminance(light.bounced), light.back ? -light.distance : light.distance);
}
