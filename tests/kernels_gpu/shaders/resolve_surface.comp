#include "lane.h"

#include "resolve_surface_access.h"

#include "kernels/shade/resolve_surface.h"

void giveSurface(INOUT(Lane) lane, Surface s) {
    giveVec3(lane, s.position, 1e-5f);
    giveVec3(lane, s.geometricNormal, 1e-5f);
    giveVec3(lane, s.shadingNormal, 1e-4f);
    giveVec3(lane, s.albedo, 1e-4f);
    giveVec3(lane, s.emission, 1e-4f);
    give(lane, s.metallic, 1e-4f);
    give(lane, s.roughness, 1e-4f);
    giveBits(lane, uint(s.material));
    giveBits(lane, uint(s.back));
    giveBits(lane, uint(s.backface));
}

void evaluate(INOUT(Lane) lane) {
    HitAccess hit;
    hit.barycentric = takeUnit2(lane) * 0.5f;
    hit.placed = takeIndex(lane, 2) == 1;
    hit.toWorld =
        mat4x3(vec3(0.0f, 2.0f, 0.0f), vec3(1.5f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f), vec3(5.0f, 6.0f, 7.0f));
    hit.normalToWorld = mat3(vec3(0.0f, 1.5f, 0.0f), vec3(2.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 3.0f));
    hit.materialIndex = 17;
    hit.tangents = takeIndex(lane, 2) == 1;
    hit.material.baseColor = takeVector(lane, 0.0f, 1.0f);
    hit.material.metallic = takeUnit(lane);
    hit.material.emission = takeVector(lane, 0.0f, 4.0f);
    hit.material.roughness = takeUnit(lane);
    hit.material.normalScale = takeUnit(lane);
    hit.material.doubleSided = takeIndex(lane, 2);
    hit.material.baseColorTexture = takeIndex(lane, 6) - 1;
    hit.material.metallicRoughnessTexture = takeIndex(lane, 6) - 1;
    hit.material.normalTexture = takeIndex(lane, 6) - 1;
    hit.material.emissiveTexture = takeIndex(lane, 6) - 1;
    // Along z, never along the surface, where the side is a matter of rounding.
    const vec3 aside = takeVector(lane, -0.3f, 0.3f);
    const vec3 direction = normalize(vec3(aside.x, aside.y, takeIndex(lane, 2) == 0 ? 1.0f : -1.0f));
    const float distance = takeBetween(lane, 0.1f, 20.0f);
    const float spread = takeBetween(lane, 0.0f, 0.01f);

    giveSurface(lane, resolveSurface(hit, direction, distance, spread));

    giveVec3(lane, edgeOf(hit, 2), 1e-6f);
    const ConeFootprint cone = footprintOn(hit, spread, distance, 0.7f);
    give(lane, cone.metres, 1e-6f);
    give(lane, cone.area, 1e-5f);
    const SomeTexture texture = openTexture(hit, takeIndex(lane, 6));
    giveVec2(lane, uvAt(hit, texture.uvSet), 1e-6f);
    give(lane, mipLevel(hit, cone, texture), 1e-4f);
    giveVec3(lane, colorAt(hit, cone, texture), 1e-4f);
    giveVec3(lane, dataAt(hit, cone, texture), 1e-4f);
    const vec4 tangent = tangentAt(hit, texture.uvSet);
    giveVec3(lane, vec3(tangent.x, tangent.y, tangent.z), 1e-5f);
    give(lane, tangent.w, 0.0f);
    const FrontNormals front = frontNormalsAt(hit, direction);
    giveVec3(lane, front.geometric, 1e-5f);
    giveVec3(lane, front.shading, 1e-5f);
    giveVec3(lane, mappedNormal(hit, cone, front.shading), 1e-4f);
    Surface surface;
    surface.backface = false;
    surface.position = vec3(0.0f);
    surface.geometricNormal = vec3(0.0f);
    surface.shadingNormal = vec3(0.0f);
    surface.material = 0;
    surface.back = false;
    shadeMaterial(hit, cone, surface);
    giveSurface(lane, surface);
}
