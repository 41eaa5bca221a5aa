#include "lane.h"

#include "kernels/shade/surface.h"

void giveVec4(INOUT(Lane) lane, vec4 v, float tolerance) {
    giveVec3(lane, vec3(v.x, v.y, v.z), tolerance);
    give(lane, v.w, tolerance);
}

// A vector of at least a tenth, since normalising amplifies rounding by the inverse of the length.
vec3 takeLong(INOUT(Lane) lane) {
    const vec3 v = takeVector(lane, -1.0f, 1.0f);
    return v + (v.x < 0.0f ? -0.1f : 0.1f) * vec3(1.0f);
}

void evaluate(INOUT(Lane) lane) {
    const vec3 a = takeLong(lane);
    const vec3 b = takeLong(lane);
    const vec3 c = takeLong(lane);
    const vec3 normal = normalize(takeLong(lane));
    const vec3 direction = takeDirection(lane);
    const vec3 texel = takeVector(lane, 0.0f, 1.0f);
    const vec2 at = takeUnit2(lane) * 0.5f;
    const vec2 uv1 = takeUnit2(lane);
    const vec2 uv2 = takeUnit2(lane);
    const float scale = takeBetween(lane, 0.0f, 2.0f);
    const mat3 linear = mat3(a, b, c);

    giveVec3(lane, unitOr(a, normal), 1e-6f);
    giveVec3(lane, unitOr(vec3(0.0f), vec3(0.0f, 1.0f, 0.0f)), 0.0f);
    giveVec2(lane, interpolate(uv1, uv2, at, at), 1e-6f);
    giveVec3(lane, interpolate(a, b, c, at), 1e-6f);
    giveVec4(lane, interpolate(vec4(a, 1.0f), vec4(b, -1.0f), vec4(c, 1.0f), at), 1e-6f);
    // On a grid, so that the sign of the uvs' area is exact.
    const vec2 grid1 = floor(uv1 * 8.0f) - 4.0f;
    const vec2 grid2 = floor(uv2 * 8.0f) - 4.0f;
    giveVec4(lane, tangentFromUvs(a, b, grid1, grid2), 1e-5f);
    const vec3 along = cross(normal, a) + normal;
    giveVec3(lane,
             mapNormal(texel + 0.6f * vec3(0.0f, 0.0f, 1.0f), scale, vec4(normalize(along), uv1.x - 0.5f), normal),
             2e-4f);
    giveVec3(lane, mapNormal(texel, scale, vec4(0.0f), normal), 1e-4f);
    giveVec3(lane, bendTowards(normal, direction), 1e-3f);
    giveVec3(lane, placePoint(mat4x3(a, b, c, texel), normal), 1e-5f);
    giveVec3(lane, placeNormal(linear, b), 1e-5f);
    giveVec3(lane, placeNormal(linear, vec3(0.0f)), 0.0f);
    // A determinant whose sign does not depend on rounding.
    const mat3 turned = mat3(vec3(0.0f, 1.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, scale + 0.1f));
    giveVec4(lane, placeTangent(turned, vec4(a, 1.0f)), 1e-6f);
    const vec3 tilted = unitOr(a, normal) + 0.5f * normal;
    const FrontNormals front = frontNormals(a, uv1.x < 0.5f ? -tilted : tilted, direction);
    giveVec3(lane, front.geometric, 1e-6f);
    giveVec3(lane, front.shading, 1e-6f);
    giveVec3(lane, frontNormals(vec3(0.0f), vec3(0.0f), direction).shading, 1e-6f);
    // Not grazing, where rounding decides the side.
    const vec3 toFront = normalize(a + 0.02f * b);
    giveBits(lane, uint(meetsBack(front, toFront)));
    giveBits(lane, uint(meetsBack(front, -toFront)));
    giveVec3(lane, facingNormals(front, toFront).geometric, 1e-6f);
    giveVec3(lane, facingNormals(front, -toFront).shading, 1e-5f);
    giveVec3(lane, surfaceAlbedo(abs(a), texel), 1e-6f);
    give(lane, surfaceMetallic(scale, texel), 1e-6f);
    give(lane, surfaceRoughness(scale, texel), 1e-6f);
}
