// Look-ups in the packed scene that no tracer needs to know triangles for: textures, materials, the lights and the sky.
//
// Whoever includes this defines PROBEGI_SCENE before, an expression of type SceneAddresses: a push constant, a uniform,
// or SceneBlock(address).scene for one that lies in memory.
#ifndef PROBEGI_VULKAN_SCENE_GLSL
#define PROBEGI_VULKAN_SCENE_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require

#include "kernels/abi/gpu_scene.h"
#include "kernels/light/punctual_light.h"
#include "kernels/light/sky.h"
#include "kernels/shade/texture.h"
#include "kernels/trace/ray_offset.h"
#include "vulkan/shaders/types.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneBlock {
    SceneAddresses scene;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneMaterials {
    GpuMaterial at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneTextures {
    GpuTexture at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneTexels {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneFloats {
    float at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneEmitters {
    GpuEmitter at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneLights {
    GpuLight at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneColors {
    vec3 at[];
};

// Four texels and their weights.
struct SceneFootprint {
    uint texel[4];
    vec4 weights;
};

SceneFootprint sceneFootprint(GpuTexture image, vec2 uv, int level) {
    const int width = mipSize(image.width, level);
    const int height = mipSize(image.height, level);
    uvec2 first = image.texels;
    if (level > 0) first = addAddress(image.mips, uvec2(4u * uint(mipOffset(image.width, image.height, level)), 0u));
    const vec2 at = transformUv(image.rowU, image.rowV, uv);
    const bool nearest = textureNearest(image.flags);
    const TexelSpan x = texelSpan(at.x, width, textureWrapU(image.flags), nearest);
    const TexelSpan y = texelSpan(at.y, height, textureWrapV(image.flags), nearest);
    SceneTexels texels = SceneTexels(addAddress(PROBEGI_SCENE.texels, first));
    const int upper = y.first * width;
    const int lower = y.second * width;
    SceneFootprint f;
    f.texel[0] = texels.at[upper + x.first];
    f.texel[1] = texels.at[upper + x.second];
    f.texel[2] = texels.at[lower + x.first];
    f.texel[3] = texels.at[lower + x.second];
    f.weights = bilinearWeights(x.fraction, y.fraction);
    return f;
}

vec3 sceneLinear(uint texel) {
    SceneFloats table = SceneFloats(PROBEGI_SCENE.srgbTable);
    return vec3(table.at[texelCode(texel, 0)], table.at[texelCode(texel, 1)], table.at[texelCode(texel, 2)]);
}

// RGB decoded from sRGB, or as it is stored, divided by 255.
vec3 textureOn(GpuTexture image, vec2 uv, int level, bool srgb) {
    const SceneFootprint f = sceneFootprint(image, uv, level);
    vec3 texel[4];
    for (int k = 0; k < 4; ++k) texel[k] = srgb ? sceneLinear(f.texel[k]) : texelCodes(f.texel[k]);
    return blendTexels(f.weights, texel[0], texel[1], texel[2], texel[3]) * (srgb ? 1.0 : 1.0 / 255.0);
}

// Between two mip levels, 0 <= level <= levels - 1.
vec3 textureBetween(GpuTexture image, vec2 uv, float level, bool srgb) {
    const int finer = int(level);
    const vec3 texel = textureOn(image, uv, finer, srgb);
    if (level == float(finer)) return texel;
    return mix(texel, textureOn(image, uv, finer + 1, srgb), level - float(finer));
}

vec3 textureColor(GpuTexture image, vec2 uv, float level) {
    return textureBetween(image, uv, level, true);
}

vec3 textureData(GpuTexture image, vec2 uv, float level) {
    return textureBetween(image, uv, level, false);
}

// Alpha divided by 255.
float textureAlpha(GpuTexture image, vec2 uv) {
    const SceneFootprint f = sceneFootprint(image, uv, 0);
    return blendTexels(f.weights, float(texelCode(f.texel[0], 3)), float(texelCode(f.texel[1], 3)),
                       float(texelCode(f.texel[2], 3)), float(texelCode(f.texel[3], 3))) *
           (1.0 / 255.0);
}

GpuTexture sceneTexture(int index) {
    return SceneTextures(PROBEGI_SCENE.textures).at[index];
}

GpuMaterial sceneMaterial(uint index) {
    return SceneMaterials(PROBEGI_SCENE.materials).at[index];
}

// EmitterSet::density.
float emitterPerArea(int material) {
    if (material < 0) return 0.0;
    return SceneMaterials(PROBEGI_SCENE.materials).at[material].emittedLuminance * PROBEGI_SCENE.inverseEmitterPower;
}

// Radiance that arrives from the sky along the unit vector `direction` (which points to the sky).
vec3 skyRadianceAt(vec3 direction) {
    const GpuSky sky = PROBEGI_SCENE.sky;
    if (sky.width <= 0) return sky.radiance;
    const SkyTexels t = skyTexels(skyUv(direction), sky.width, sky.height);
    SceneColors pixels = SceneColors(PROBEGI_SCENE.skyPixels);
    const int upper = t.upper * sky.width;
    const int lower = t.lower * sky.width;
    return sky.radiance * blendSky(t, pixels.at[upper + t.left], pixels.at[upper + t.right], pixels.at[lower + t.left],
                                   pixels.at[lower + t.right]);
}

// What a point receives from light `index` (0 <= index < PROBEGI_SCENE.lightCount), without shadows.
LightSample lightSampleAt(int index, vec3 point) {
    const GpuLight light = SceneLights(PROBEGI_SCENE.lights).at[index];
    return samplePunctual(light.type, light.position, light.direction, light.intensity, light.range, light.cosInner,
                          light.cosOuter, point);
}

// The ray whose occlusion tells whether a surface point sees the light. `geometricNormal` is on the lit side.
Ray shadowRay(vec3 position, vec3 geometricNormal, LightSample light) {
    return Ray(offsetOrigin(position, geometricNormal, PROBEGI_SCENE.magnitude), 0.0, light.toLight,
               shadowRayEnd(light.distance));
}

#endif
