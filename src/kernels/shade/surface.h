// Surface properties at a hit: normals, normal mapping, and the material's factors times texels.
#ifndef PROBEGI_KERNELS_SURFACE_H
#define PROBEGI_KERNELS_SURFACE_H

#include "kernels/language.h"

KERNELS_BEGIN

// Minimum cosine between the shading normal and the direction to the ray's origin.
KERNEL_CONST float kLeastCosine = 1e-3f;

KERNEL_FN vec3 unitOr(vec3 v, vec3 fallback) {
    const float square = dot(v, v);
    return square > 1e-30f && square < 1e30f ? v * (1.0f / sqrt(square)) : fallback;
}

// `barycentric`: weights of the second and third corner.
KERNEL_FN vec2 interpolate(vec2 a, vec2 b, vec2 c, vec2 barycentric) {
    return (1.0f - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c;
}

KERNEL_FN vec3 interpolate(vec3 a, vec3 b, vec3 c, vec2 barycentric) {
    return (1.0f - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c;
}

KERNEL_FN vec4 interpolate(vec4 a, vec4 b, vec4 c, vec2 barycentric) {
    return (1.0f - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c;
}

// Tangent along u, w = side of the bitangent; zero if the uvs are degenerate. Edges are from the first corner to the
// others, in space and in uv.
KERNEL_FN vec4 tangentFromUvs(vec3 edge1, vec3 edge2, vec2 uvEdge1, vec2 uvEdge2) {
    const float area = uvEdge1.x * uvEdge2.y - uvEdge2.x * uvEdge1.y;
    // glTF's v axis points down in the image while the bitangent points up in it, hence the opposite sign.
    const float side = area < 0.0f ? 1.0f : -1.0f;
    const vec3 along = -side * (uvEdge2.y * edge1 - uvEdge1.y * edge2);
    return vec4(along, side);
}

// Normal map of glTF 2.0, section 3.9.3: (2c - 1) with xy scaled, in the frame (tangent, bitangent, normal).
KERNEL_FN vec3 mapNormal(vec3 texel, float scale, vec4 tangent, vec3 normal) {
    const vec3 along = vec3(tangent.x, tangent.y, tangent.z);
    const vec3 t = unitOr(along - normal * dot(normal, along), vec3(0.0f));
    const vec3 bitangent = cross(normal, t) * (tangent.w < 0.0f ? -1.0f : 1.0f);
    const vec3 local = 2.0f * texel - 1.0f;
    return unitOr((local.x * scale) * t + (local.y * scale) * bitangent + local.z * normal, normal);
}

// Makes a normal face the ray's origin, by adding the least necessary amount of the direction to the origin.
KERNEL_FN vec3 bendTowards(vec3 normal, vec3 toOrigin) {
    const float cosine = dot(normal, toOrigin);
    if (cosine >= kLeastCosine) return normal;
    return unitOr(normal + (kLeastCosine - cosine) * toOrigin, toOrigin);
}

// A mesh-space point under an instance's transform. The order of the sum is spelt out: languages differ in theirs.
KERNEL_FN vec3 placePoint(mat4x3 toWorld, vec3 point) {
    return (toWorld[0] * point.x + toWorld[1] * point.y) + (toWorld[2] * point.z + toWorld[3]);
}

// A mesh-space normal of any length under an instance's normal matrix; only its direction counts.
KERNEL_FN vec3 placeNormal(mat3 normalToWorld, vec3 normal) {
    return normalToWorld * unitOr(normal, vec3(0.0f));
}

// A mesh-space tangent under an instance's linear part: mirroring changes the bitangent's side.
KERNEL_FN vec4 placeTangent(mat3 toWorld, vec4 tangent) {
    const float volume = dot(cross(toWorld[0], toWorld[1]), toWorld[2]);
    const vec3 along = toWorld * vec3(tangent.x, tangent.y, tangent.z);
    return vec4(along, volume < 0.0f ? -tangent.w : tangent.w);
}

// The unit normals of the front.
struct FrontNormals {
    vec3 geometric;
    vec3 shading;
};

// From the cross product of the triangle's edges and the interpolated normal (zero: none), of any length. The winding
// decides which side is the front (glTF 2.0, section 3.7.2.1); some meshes' normals disagree.
KERNEL_FN FrontNormals frontNormals(vec3 edgeCross, vec3 interpolated, vec3 toOrigin) {
    FrontNormals n;
    n.geometric = unitOr(edgeCross, toOrigin);
    n.shading = unitOr(interpolated, n.geometric);
    if (dot(n.shading, n.geometric) < 0.0f) n.shading = -n.shading;
    return n;
}

// Whether the ray hits the back.
KERNEL_FN bool meetsBack(FrontNormals n, vec3 direction) {
    return dot(n.geometric, direction) > 0.0f;
}

// The normals flipped to the side of the ray's origin. A shading normal that still faces away is bent to just above
// grazing, so that every BSDF is defined.
KERNEL_FN FrontNormals facingNormals(FrontNormals n, vec3 direction) {
    const bool away = meetsBack(n, direction);
    FrontNormals facing;
    facing.geometric = away ? -n.geometric : n.geometric;
    facing.shading = bendTowards(away ? -n.shading : n.shading, -direction);
    return facing;
}

// glTF 2.0, section 3.9.2: factors times texels, the roughness in G and the metalness in B.
KERNEL_FN vec3 surfaceAlbedo(vec3 factor, vec3 texel) {
    return clamp(factor * texel, 0.0f, 1.0f);
}

KERNEL_FN float surfaceMetallic(float factor, vec3 texel) {
    return factor * texel.z;
}

KERNEL_FN float surfaceRoughness(float factor, vec3 texel) {
    return factor * texel.y;
}

KERNELS_END

#endif
