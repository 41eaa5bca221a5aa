#include "lane.h"

#include "kernels/screen/glossy_ray.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 normal = takeDirection(lane);
    const vec3 view = takeDirection(lane);
    const vec3 towards = dot(view, normal) < 0.0f ? view : -view;
    // Roughness and angles as in bsdf.comp.
    const float roughness = takeBetween(lane, 0.25f, 1.0f);
    const float turn = takeUnit(lane);
    const vec2 u = vec2(turn, takeBetween(lane, 0.0f, 0.9f));
    const int x = takeIndex(lane, 9000);
    const int y = takeIndex(lane, 9000);
    const int plane = takeIndex(lane, 64);
    give(lane, glossyRayShare(takeUnit(lane)), 1e-5f);
    give(lane, float(glossyBlocks(x)), 0.0f);
    give(lane, float(glossyCandidate(plane, x & 3)), 0.0f);
    giveVec2(lane, glossyPattern(x, y, plane), 1e-3f);
    give(lane, float(glossyBayer(x, y, plane & 3)), 0.0f);
    give(lane, glossyReach(float(x), float(y)), 1e-6f);
    giveVec3(lane, aboveSurface(towards, normal), 1e-5f);
    giveVec3(lane, mirrorDirection(normal, normal, towards), 1e-5f);
    // Near the horizon a rounding decides on which side the direction is mirrored, which the height's size does not
    // see.
    const float cosine = -dot(towards, normal);
    const vec3 ray = glossyDirection(normal, normal, towards, roughness, u);
    give(lane, cosine > 0.1f ? dot(ray, normal) : 0.0f, 1e-3f);
    giveVec3(lane, glossyDirection(normal, normal, towards, 0.0f, u), 1e-5f);
    const vec3 baseColor = takeVector(lane, 0.0f, 1.0f);
    const Bsdf b = makeBsdf(baseColor, takeUnit(lane), roughness, false);
    const float cosO = takeBetween(lane, 0.01f, 1.0f);
    const vec3 irradiance = takeVector(lane, 0.0f, 10.0f);
    const vec3 radiance = takeVector(lane, 0.0f, 10.0f);
    giveVec3(lane, radianceOfIrradiance(irradiance), 1e-6f);
    giveVec3(lane, diffuseRadiance(b, cosO, irradiance), 1e-5f);
    giveVec3(lane, glossyRadiance(b, cosO, radiance), 1e-4f);
    giveVec3(lane, hitRadiance(b, cosO, vec3(turn), irradiance, radiance), 1e-4f);
}
