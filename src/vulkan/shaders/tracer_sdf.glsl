// Primitives by exact intersection. Its block (SdfSceneTracer::block) has the addresses of their geometry and of what
// they look like, and their number.
#ifndef PROBEGI_TRACER_SDF_GLSL
#define PROBEGI_TRACER_SDF_GLSL

#include "kernels/sdf/primitive.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SdfSolids {
    SdfSolid at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SdfPaints {
    SdfPaint at[];
};

SdfSolid sdfSolid(int number) {
    return SdfSolids(sceneConstants.tracer.addresses[0]).at[number];
}

#include "kernels/sdf/exact_hit.h"

Hit closestHit(Ray ray) {
    bool within;
    const SdfFound found = sdfClosestHit(ray.origin, max(ray.near, 0.0), ray.direction, ray.far,
                                         int(sceneConstants.tracer.numbers[0]), within);
    if (found.solid < 0) return Hit(kNoHitDistance, -1, -1, -1, vec2(0.0));
    return Hit(found.distance, found.solid, within ? kSdfFromWithin : kSdfFront, -1, vec2(0.0));
}

bool occluded(Ray ray) {
    return sdfIsBlocked(ray.origin, max(ray.near, 0.0), ray.direction, ray.far, int(sceneConstants.tracer.numbers[0]));
}

Surface surfaceAt(Ray ray, Hit hit, float spread) {
    const SdfPaint paint = SdfPaints(sceneConstants.tracer.addresses[1]).at[hit.primitive];
    const bool within = hit.geometry == kSdfFromWithin;
    Surface surface;
    surface.position = ray.origin + ray.direction * hit.distance;
    const vec3 normal = sdfSurfaceNormal(sdfSolid(hit.primitive), surface.position);
    surface.geometricNormal = within ? -normal : normal;
    surface.shadingNormal = bendTowards(surface.geometricNormal, -ray.direction);
    surface.albedo = paint.albedo;
    surface.emission = within ? vec3(0.0) : paint.emission;
    surface.metallic = 0.0;
    surface.roughness = 1.0;
    surface.material = -1;
    surface.back = within;
    surface.backface = within;
    return surface;
}

#endif
