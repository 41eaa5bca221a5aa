// A triangle for resolve_surface.h, with textures of closed form: their number is the material's reference.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_RESOLVE_SURFACE_ACCESS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_RESOLVE_SURFACE_ACCESS_H

#include "kernels/shade/texture.h"

KERNELS_BEGIN

struct Surface {
    vec3 position;
    vec3 geometricNormal;
    vec3 shadingNormal;
    vec3 albedo;
    vec3 emission;
    float metallic;
    float roughness;
    int material;
    bool back;
    bool backface;
};

struct SomeMaterial {
    vec3 baseColor;
    float metallic;
    vec3 emission;
    float roughness;
    float normalScale;
    int doubleSided;
    int baseColorTexture;  // -1: none
    int metallicRoughnessTexture;
    int normalTexture;
    int emissiveTexture;
};

struct SomeTexture {
    int number;
    int uvSet;
    int levels;
};

struct HitAccess {
    vec2 barycentric;
    bool placed;
    mat4x3 toWorld;
    mat3 normalToWorld;
    int materialIndex;
    SomeMaterial material;
    bool tangents;
#ifdef __cplusplus
    using Surface = kernels::Surface;
    using SurfaceTexture = SomeTexture;
#endif
};
#ifndef __cplusplus
#define SurfaceTexture SomeTexture
#endif

KERNEL_FN vec3 cornerPosition(IN(HitAccess), int corner) {
    return corner == 0 ? vec3(0.1f, 0.2f, 0.3f) : (corner == 1 ? vec3(2.1f, 0.2f, 0.8f) : vec3(0.1f, 3.2f, -0.2f));
}
KERNEL_FN vec3 cornerNormal(IN(HitAccess), int corner) {
    return corner == 0 ? vec3(0.0f, 0.0f, 1.0f) : (corner == 1 ? vec3(0.6f, 0.0f, 0.8f) : vec3(0.0f, 0.6f, 0.8f));
}
KERNEL_FN vec2 cornerUv(IN(HitAccess), int corner, int uvSet) {
    const float scale = uvSet == 0 ? 1.0f : 3.0f;
    return scale * (corner == 0 ? vec2(0.1f, 0.2f) : (corner == 1 ? vec2(0.9f, 0.3f) : vec2(0.2f, 0.8f)));
}
KERNEL_FN bool hasTangents(IN(HitAccess) hit) {
    return hit.tangents;
}
KERNEL_FN vec4 cornerTangent(IN(HitAccess), int corner) {
    return vec4(1.0f, 0.25f * float(corner), 0.0f, -1.0f);
}

KERNEL_FN bool isTexture(IN(HitAccess), int texture) {
    return texture >= 0;
}
KERNEL_FN SomeTexture openTexture(IN(HitAccess), int texture) {
    SomeTexture opened;
    opened.number = texture;
    opened.uvSet = texture % 2;
    opened.levels = texture < 4 ? 6 : 1;
    return opened;
}
KERNEL_FN int textureUvSet(IN(HitAccess), SomeTexture texture) {
    return texture.uvSet;
}
KERNEL_FN int textureLevels(IN(HitAccess), SomeTexture texture) {
    return texture.levels;
}
KERNEL_FN float textureDensity(IN(HitAccess), SomeTexture texture) {
    return 4096.0f * float(texture.number + 1);
}
KERNEL_FN vec3 textureColor(IN(HitAccess), SomeTexture texture, vec2 uv, float level) {
    return vec3(0.2f * uv.x, 0.1f + 0.2f * uv.y, 0.1f * level) + 0.01f * float(texture.number);
}
KERNEL_FN vec3 textureData(IN(HitAccess), SomeTexture texture, vec2 uv, float level) {
    return vec3(0.4f + 0.1f * uv.x, 0.6f - 0.1f * uv.y, 0.9f - 0.05f * level) - 0.01f * float(texture.number);
}

KERNELS_END

#endif
