// The scene in GPU buffers: the records that C++ packs (src/vulkan/scene/scene_data.h) and shaders read
// (src/vulkan/shaders/scene.glsl). Scalar layout (GL_EXT_scalar_block_layout): no padding, as in C++ with 4-byte
// members. Indices count records, not bytes.
#ifndef PROBEGI_KERNELS_GPU_SCENE_H
#define PROBEGI_KERNELS_GPU_SCENE_H

#include "kernels/language.h"

KERNELS_BEGIN

struct GpuVertex {
    vec3 position;
    vec3 normal;  // unit; zero: the mesh has none
    vec2 uv;
};

struct GpuTriangle {
    uvec3 vertex;  // within the mesh
    uint material;
};

// Triangles of one space, all opaque or all masked. Group g of a scene has the meshes 2 g (opaque) and 2 g + 1
// (masked); group 0 is the world.
struct GpuMesh {
    uint firstVertex;
    uint firstTriangle;
    uint triangleCount;
    int firstUv1;      // -1: no second uv set
    int firstTangent;  // -1: no tangents
};

// A placed group. Matrices are 3-component columns; the implied last row is 0 0 0 1.
struct GpuInstance {
    mat4x3 toWorld;
    mat4x3 toObject;
    mat3 normalToWorld;
    int group;
};

// A texture reference.
struct GpuTexture {
    uvec2 texels;  // byte offset of the image's texels within all texels, low word first
    int width;
    int height;
    vec3 rowU;  // upper two rows of the uv transform
    vec3 rowV;
    uint flags;  // textureWrapU() and so on
    int levels;  // mip levels; 1: level 0 only
    uvec2 mips;  // byte offset of level 1 within all texels; the others follow
};

struct GpuMaterial {
    vec3 baseColor;
    float metallic;
    vec3 emission;
    float roughness;
    float normalScale;
    float textureAlphaCutoff;  // threshold for the texture's alpha
    int doubleSided;
    int baseColorTexture;  // -1: none, here and below
    int metallicRoughnessTexture;
    int normalTexture;
    int emissiveTexture;
    float emittedLuminance;  // EmitterSet::luminance
};

// probegi::EmissiveTriangle.
struct GpuEmitter {
    vec3 corner;
    uint upTo;
    vec3 edge1;
    int material;
    vec3 edge2;
};

struct GpuLight {
    vec3 position;
    int type;  // kLightDirectional ...
    vec3 direction;
    float range;
    vec3 intensity;
    float cosInner;
    float cosOuter;
};

struct GpuSky {
    vec3 radiance;  // multiplies the image, if there is one
    int width;      // 0: no image
    int height;
};

// Buffer device addresses of all arrays, low word first, each a multiple of 16. Empty arrays may have any address.
struct SceneAddresses {
    uvec2 vertices;
    uvec2 triangles;
    uvec2 uv1;
    uvec2 tangents;
    uvec2 meshes;
    uvec2 instances;
    uvec2 materials;
    uvec2 textures;
    uvec2 texels;     // RGBA, 8 bits each, R in the lowest byte; level 0 of all images and their mips
    uvec2 srgbTable;  // 256 floats: the linear value of each 8-bit sRGB code
    uvec2 lights;
    uvec2 skyPixels;  // vec3, row-major, top row first
    GpuSky sky;
    int lightCount;
    float magnitude;  // the largest absolute coordinate of the scene's bounds
    uvec2 emitters;   // GpuEmitter
    int emitterCount;
    float inverseEmitterPower;  // EmitterSet's
};

KERNEL_CONST uint kTextureNearest = 16u;
KERNEL_CONST uint kTextureSecondUv = 32u;

// GpuTexture::flags. Wraps as in kernels/shade/texture.h.
KERNEL_FN uint packTextureFlags(int wrapU, int wrapV, bool nearest, int texCoord) {
    return uint(wrapU) | (uint(wrapV) << 2u) | (nearest ? kTextureNearest : 0u) |
           (texCoord == 1 ? kTextureSecondUv : 0u);
}

KERNEL_FN int textureWrapU(uint flags) {
    return int(flags & 3u);
}

KERNEL_FN int textureWrapV(uint flags) {
    return int((flags >> 2u) & 3u);
}

KERNEL_FN bool textureNearest(uint flags) {
    return (flags & kTextureNearest) != 0u;
}

KERNEL_FN int textureUvSet(uint flags) {
    return (flags & kTextureSecondUv) != 0u ? 1 : 0;
}

// Sum of two 64-bit numbers, low words first, so that devices need no 64-bit integers.
KERNEL_FN uvec2 addAddress(uvec2 a, uvec2 b) {
    const uint low = a.x + b.x;
    return uvec2(low, a.y + b.y + (low < a.x ? 1u : 0u));
}

// The 8-bit code of a texel's channel (0: red ... 3: alpha).
KERNEL_FN uint texelCode(uint texel, int channel) {
    return (texel >> uint(8 * channel)) & 255u;
}

// RGB as stored, 0..255.
KERNEL_FN vec3 texelCodes(uint texel) {
    return vec3(float(texelCode(texel, 0)), float(texelCode(texel, 1)), float(texelCode(texel, 2)));
}

KERNELS_END

#endif
