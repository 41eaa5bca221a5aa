// What a hit on a triangle looks like to light: its place, its normals, and its material with the textures looked up on
// the mip level for the ray's cone.
//
// The text knows meshes and textures by a HitAccess alone. In GLSL that is a struct, and Surface (kernels do not
// include the public shared/rays.h) and SurfaceTexture are types, all defined before this header is included, as are
// the functions below; in C++ a class of any name with the two types as its members, for the text is templates there,
// with the functions beside it.
//
//     vec2 barycentric;  // members: weights of the second and third corner
//     bool placed;       // whether the mesh is an instance; the next two are read only if so
//     mat4x3 toWorld;
//     mat3 normalToWorld;
//     int materialIndex;
//     material;          // a struct: baseColor, metallic, emission, roughness, normalScale, doubleSided, and
//                        // baseColorTexture, metallicRoughnessTexture, normalTexture, emissiveTexture, of any type
//
//     vec3 cornerPosition(HitAccess hit, int corner)       // 0 to 2; in the mesh's space
//     vec3 cornerNormal(HitAccess hit, int corner)         // unit; zero: the mesh has none
//     vec2 cornerUv(HitAccess hit, int corner, int uvSet)
//     bool hasTangents(HitAccess hit)
//     vec4 cornerTangent(HitAccess hit, int corner)        // w is 0: derived from the uvs
//
//     bool isTexture(HitAccess hit, T texture)             // T: of a material's textures
//     SurfaceTexture openTexture(HitAccess hit, T texture) // where it is one
//     int textureUvSet(HitAccess hit, SurfaceTexture texture)
//     int textureLevels(HitAccess hit, SurfaceTexture texture)                         // 1: level 0 only
//     float textureDensity(HitAccess hit, SurfaceTexture texture)                      // texelsPerUvArea()
//     vec3 textureColor(HitAccess hit, SurfaceTexture texture, vec2 uv, float level)   // linear
//     vec3 textureData(HitAccess hit, SurfaceTexture texture, vec2 uv, float level)    // as stored, 0..1
#ifndef PROBEGI_KERNELS_RESOLVE_SURFACE_H
#define PROBEGI_KERNELS_RESOLVE_SURFACE_H

#include "kernels/screen/colour.h"
#include "kernels/shade/surface.h"
#include "kernels/shade/texture.h"

#ifdef __cplusplus
#define HIT_FN                 \
    template <class HitAccess> \
    KERNEL_FN
#define OF_HIT(T) typename HitAccess::T
#else
#define HIT_FN
#define OF_HIT(T) T
#endif

KERNELS_BEGIN

// What a ray's cone covers of a triangle.
struct ConeFootprint {
    float metres;  // across; 0: textures are not filtered
    float area;    // of the triangle in world space, twice
};

// From the first corner to another, in the mesh's space.
HIT_FN vec3 edgeOf(IN(HitAccess) hit, int corner) {
    return cornerPosition(hit, corner) - cornerPosition(hit, 0);
}

HIT_FN ConeFootprint footprintOn(IN(HitAccess) hit, float spread, float distance, float cosine) {
    vec3 edge1 = edgeOf(hit, 1);
    vec3 edge2 = edgeOf(hit, 2);
    if (hit.placed) {
        edge1 = mat3(hit.toWorld) * edge1;
        edge2 = mat3(hit.toWorld) * edge2;
    }
    ConeFootprint cone;
    cone.metres = coneFootprint(spread, distance, cosine);
    cone.area = length(cross(edge1, edge2));
    return cone;
}

HIT_FN vec2 uvAt(IN(HitAccess) hit, int uvSet) {
    return interpolate(cornerUv(hit, 0, uvSet), cornerUv(hit, 1, uvSet), cornerUv(hit, 2, uvSet), hit.barycentric);
}

HIT_FN float mipLevel(IN(HitAccess) hit, ConeFootprint cone, IN(OF_HIT(SurfaceTexture)) texture) {
    const int levels = textureLevels(hit, texture);
    if (cone.metres <= 0.0f || levels == 1) return 0.0f;
    const int set = textureUvSet(hit, texture);
    const float area = uvArea(cornerUv(hit, 0, set), cornerUv(hit, 1, set), cornerUv(hit, 2, set));
    return footprintLevel(cone.metres, area * textureDensity(hit, texture), cone.area, levels);
}

HIT_FN vec3 colorAt(IN(HitAccess) hit, ConeFootprint cone, IN(OF_HIT(SurfaceTexture)) texture) {
    return textureColor(hit, texture, uvAt(hit, textureUvSet(hit, texture)), mipLevel(hit, cone, texture));
}

HIT_FN vec3 dataAt(IN(HitAccess) hit, ConeFootprint cone, IN(OF_HIT(SurfaceTexture)) texture) {
    return textureData(hit, texture, uvAt(hit, textureUvSet(hit, texture)), mipLevel(hit, cone, texture));
}

// In the mesh's space: the mesh's own, or from the uvs that the normal map uses.
HIT_FN vec4 tangentAt(IN(HitAccess) hit, int uvSet) {
    if (hasTangents(hit)) {
        const vec4 given =
            interpolate(cornerTangent(hit, 0), cornerTangent(hit, 1), cornerTangent(hit, 2), hit.barycentric);
        if (given.w != 0.0f) return given;
    }
    const vec2 uv = cornerUv(hit, 0, uvSet);
    return tangentFromUvs(edgeOf(hit, 1), edgeOf(hit, 2), cornerUv(hit, 1, uvSet) - uv, cornerUv(hit, 2, uvSet) - uv);
}

// Before normal mapping.
HIT_FN FrontNormals frontNormalsAt(IN(HitAccess) hit, vec3 direction) {
    vec3 edgeCross = cross(edgeOf(hit, 1), edgeOf(hit, 2));
    vec3 normal = interpolate(cornerNormal(hit, 0), cornerNormal(hit, 1), cornerNormal(hit, 2), hit.barycentric);
    if (hit.placed) {
        edgeCross = placeNormal(hit.normalToWorld, edgeCross);
        normal = placeNormal(hit.normalToWorld, normal);
    }
    return frontNormals(edgeCross, normal, -direction);
}

HIT_FN vec3 mappedNormal(IN(HitAccess) hit, ConeFootprint cone, vec3 normal) {
    if (!isTexture(hit, hit.material.normalTexture) || hit.material.normalScale == 0.0f) return normal;
    vec4 tangent = tangentAt(hit, textureUvSet(hit, openTexture(hit, hit.material.normalTexture)));
    if (hit.placed) tangent = placeTangent(mat3(hit.toWorld), tangent);
    const vec3 texel = dataAt(hit, cone, openTexture(hit, hit.material.normalTexture));
    return mapNormal(texel, hit.material.normalScale, tangent, normal);
}

// Colours of the front, and of both sides where the material has two.
HIT_FN void shadeMaterial(IN(HitAccess) hit, ConeFootprint cone, INOUT(OF_HIT(Surface)) surface) {
    surface.metallic = hit.material.metallic;
    surface.roughness = hit.material.roughness;
    surface.albedo = vec3(0.0f);
    surface.emission = vec3(0.0f);
    if (surface.backface) return;
    vec3 color = vec3(1.0f);
    if (isTexture(hit, hit.material.baseColorTexture))
        color = colorAt(hit, cone, openTexture(hit, hit.material.baseColorTexture));
    surface.albedo = surfaceAlbedo(hit.material.baseColor, color);
    if (isTexture(hit, hit.material.metallicRoughnessTexture)) {
        const vec3 texel = dataAt(hit, cone, openTexture(hit, hit.material.metallicRoughnessTexture));
        surface.metallic = surfaceMetallic(hit.material.metallic, texel);
        surface.roughness = surfaceRoughness(hit.material.roughness, texel);
    }
    if (!anyPositive(hit.material.emission)) return;
    surface.emission = hit.material.emission;
    if (isTexture(hit, hit.material.emissiveTexture))
        surface.emission *= colorAt(hit, cone, openTexture(hit, hit.material.emissiveTexture));
}

// Resolves a hit `distance` metres along a ray. `spread`: angle of the ray's cone in radians, by which textures are
// filtered; 0: not at all.
HIT_FN OF_HIT(Surface) resolveSurface(IN(HitAccess) hit, vec3 direction, float distance, float spread) {
    vec3 position =
        interpolate(cornerPosition(hit, 0), cornerPosition(hit, 1), cornerPosition(hit, 2), hit.barycentric);
    if (hit.placed) position = placePoint(mat4x3(hit.toWorld), position);
    FrontNormals front = frontNormalsAt(hit, direction);
    ConeFootprint cone;
    cone.metres = 0.0f;
    cone.area = 0.0f;
    if (spread > 0.0f) cone = footprintOn(hit, spread, distance, dot(front.geometric, direction));
    front.shading = mappedNormal(hit, cone, front.shading);
    const FrontNormals facing = facingNormals(front, direction);
    OF_HIT(Surface) surface;
    surface.position = position;
    surface.geometricNormal = facing.geometric;
    surface.shadingNormal = facing.shading;
    surface.back = meetsBack(front, direction);
    surface.backface = surface.back && !bool(hit.material.doubleSided);
    surface.material = hit.materialIndex;
    shadeMaterial(hit, cone, surface);
    return surface;
}

KERNELS_END

#endif
