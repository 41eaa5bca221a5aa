// Primitives by exact intersection or, where there are clusters, by the paper's sphere tracing. Its block
// (SdfSceneTracer::block) has the addresses of their geometry, of what they look like, of clusters and numbers, and of
// the texels of faces; and how many primitives and clusters there are.
#ifndef PROBEGI_TRACER_SDF_GLSL
#define PROBEGI_TRACER_SDF_GLSL

#include "kernels/sdf/cluster.h"
#include "kernels/sdf/face_texels.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SdfSolids {
    SdfSolid at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SdfPaints {
    SdfPaint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SdfTexels {
    uint at[];
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SdfClusterList {
    SdfCluster at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SdfNumbers {
    int at[];
};

SdfSolid sdfSolid(int number) {
    return SdfSolids(sceneConstants.tracer.addresses[0]).at[number];
}

SdfCluster sdfCluster(int number) {
    return SdfClusterList(sceneConstants.tracer.addresses[2]).at[number];
}

#include "kernels/sdf/exact_hit.h"
#include "kernels/sdf/sphere_trace.h"

int sdfSolidCount() {
    return int(sceneConstants.tracer.numbers[0]);
}
int sdfClusterCount() {
    return int(sceneConstants.tracer.numbers[1]);
}

// Of a stored primitive, and back.
int sdfGivenNumber(int solid) {
    return sdfClusterCount() == 0 ? solid : SdfNumbers(sceneConstants.tracer.addresses[3]).at[solid];
}
int sdfStoredNumber(int primitive) {
    return sdfClusterCount() == 0 ? primitive : SdfNumbers(sceneConstants.tracer.addresses[4]).at[primitive];
}

// Sphere tracing is for rays that begin outside.
bool sdfIsSphereTraced(Ray ray, float near) {
    if (sdfClusterCount() == 0 || !bvhRayIsValid(ray.origin, near, ray.direction, ray.far)) return false;
    return sdfNearest(ray.origin + ray.direction * near, kSdfFar, sdfClusterCount()).distance > 0.0;
}

Hit closestHit(Ray ray) {
    const float near = max(ray.near, 0.0);
    bool within = false;
    SdfFound found;
    if (sdfIsSphereTraced(ray, near))
        found = sdfSphereTraced(ray.origin, near, ray.direction, ray.far, sdfClusterCount());
    else
        found = sdfClosestHit(ray.origin, near, ray.direction, ray.far, sdfSolidCount(), within);
    if (found.solid < 0) return Hit(kNoHitDistance, -1, -1, -1, vec2(0.0));
    return Hit(found.distance, sdfGivenNumber(found.solid), within ? kSdfFromWithin : kSdfFront, -1, vec2(0.0));
}

bool occluded(Ray ray) {
    const float near = max(ray.near, 0.0);
    if (sdfIsSphereTraced(ray, near))
        return sdfSphereTraced(ray.origin, near, ray.direction, ray.far, sdfClusterCount()).solid >= 0;
    return sdfIsBlocked(ray.origin, near, ray.direction, ray.far, sdfSolidCount());
}

vec3 sdfFaceColourAt(SdfSolid solid, int faces, vec3 position) {
    const SdfFacePoint at = sdfFacePointAt(solid, position);
    SdfTexels texels = SdfTexels(sceneConstants.tracer.addresses[5]);
    const int first = faces + at.first;
    return sdfFaceColour(at, texels.at[first], texels.at[first + 1], texels.at[first + kSdfFaceSide],
                         texels.at[first + kSdfFaceSide + 1]);
}

// emitterMaterial() in src/sdf/sdf_emitters.h.
int sdfEmitterMaterial(int primitive) {
    return PROBEGI_SCENE.emitterCount > 0 && emitterPerArea(primitive) > 0.0 ? primitive : -1;
}

Surface surfaceAt(Ray ray, Hit hit, float spread) {
    const SdfPaint paint = SdfPaints(sceneConstants.tracer.addresses[1]).at[hit.primitive];
    const bool within = hit.geometry == kSdfFromWithin;
    Surface surface;
    surface.position = ray.origin + ray.direction * hit.distance;
    const SdfSolid solid = sdfSolid(sdfStoredNumber(hit.primitive));
    const vec3 normal = sdfSurfaceNormal(solid, surface.position);
    surface.geometricNormal = within ? -normal : normal;
    surface.shadingNormal = bendTowards(surface.geometricNormal, -ray.direction);
    surface.albedo = paint.faces < 0 ? paint.albedo : sdfFaceColourAt(solid, paint.faces, surface.position);
    surface.emission = within ? vec3(0.0) : paint.emission;
    surface.metallic = 0.0;
    surface.roughness = 1.0;
    surface.material = sdfEmitterMaterial(hit.primitive);
    surface.back = within;
    surface.backface = within;
    return surface;
}

#endif
