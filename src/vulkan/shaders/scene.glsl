// Look-ups in the packed scene: what a hit looks like, which candidate hits count, the lights and the sky. The same
// steps as src/geometry/surface_shader.cpp, on the same formulas.
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
#include "kernels/trace/ray_offset.h"
#include "kernels/light/sky.h"
#include "kernels/shade/surface.h"
#include "kernels/shade/texture.h"
#include "vulkan/shaders/types.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneBlock {
    SceneAddresses scene;
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer SceneVertices {
    GpuVertex at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer SceneTriangles {
    GpuTriangle at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer SceneUvs {
    vec2 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer SceneTangents {
    vec4 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneMeshes {
    GpuMesh at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SceneInstances {
    GpuInstance at[];
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

// RGB decoded from sRGB.
vec3 textureColorOn(GpuTexture image, vec2 uv, int level) {
    const SceneFootprint f = sceneFootprint(image, uv, level);
    return blendTexels(f.weights, sceneLinear(f.texel[0]), sceneLinear(f.texel[1]), sceneLinear(f.texel[2]),
                       sceneLinear(f.texel[3]));
}

// RGB as it is stored, divided by 255.
vec3 textureDataOn(GpuTexture image, vec2 uv, int level) {
    const SceneFootprint f = sceneFootprint(image, uv, level);
    return blendTexels(f.weights, texelCodes(f.texel[0]), texelCodes(f.texel[1]), texelCodes(f.texel[2]),
                       texelCodes(f.texel[3])) *
           (1.0 / 255.0);
}

// Between two mip levels, 0 <= level <= levels - 1.
vec3 textureColor(GpuTexture image, vec2 uv, float level) {
    const int finer = int(level);
    const vec3 texel = textureColorOn(image, uv, finer);
    if (level == float(finer)) return texel;
    return mix(texel, textureColorOn(image, uv, finer + 1), level - float(finer));
}

vec3 textureData(GpuTexture image, vec2 uv, float level) {
    const int finer = int(level);
    const vec3 texel = textureDataOn(image, uv, finer);
    if (level == float(finer)) return texel;
    return mix(texel, textureDataOn(image, uv, finer + 1), level - float(finer));
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
    return SceneMaterials(PROBEGI_SCENE.materials).at[material].emittedLuminance * PROBEGI_SCENE.inverseEmitterPower;
}

// The mesh of a hit.
GpuMesh sceneMesh(int instance, int geometry) {
    int group = 0;
    if (instance >= 0) group = SceneInstances(PROBEGI_SCENE.instances).at[instance].group;
    return SceneMeshes(PROBEGI_SCENE.meshes).at[2 * group + geometry];
}

GpuTriangle sceneTriangle(GpuMesh mesh, int primitive) {
    return SceneTriangles(PROBEGI_SCENE.triangles).at[mesh.firstTriangle + uint(primitive)];
}

GpuVertex sceneVertex(GpuMesh mesh, uint vertex) {
    return SceneVertices(PROBEGI_SCENE.vertices).at[mesh.firstVertex + vertex];
}

// A triangle's uvs of one set, by corner.
struct CornerUvs {
    vec2 a;
    vec2 b;
    vec2 c;
};

CornerUvs sceneSecondUvs(GpuMesh mesh, GpuTriangle triangle) {
    if (mesh.firstUv1 < 0) return CornerUvs(vec2(0.0), vec2(0.0), vec2(0.0));
    SceneUvs uvs = SceneUvs(PROBEGI_SCENE.uv1);
    const uint first = uint(mesh.firstUv1);
    return CornerUvs(uvs.at[first + triangle.vertex.x], uvs.at[first + triangle.vertex.y],
                     uvs.at[first + triangle.vertex.z]);
}

// A triangle's corners in the mesh's space and where on it a hit is.
struct SceneCorners {
    GpuMesh mesh;
    GpuTriangle triangle;
    GpuVertex a;
    GpuVertex b;
    GpuVertex c;
    vec2 barycentric;
};

CornerUvs sceneUvs(SceneCorners t, int uvSet) {
    if (uvSet == 0) return CornerUvs(t.a.uv, t.b.uv, t.c.uv);
    return sceneSecondUvs(t.mesh, t.triangle);
}

// Where a texture is looked up.
vec2 sceneUv(SceneCorners t, GpuTexture image) {
    const CornerUvs uvs = sceneUvs(t, textureUvSet(image.flags));
    return interpolate(uvs.a, uvs.b, uvs.c, t.barycentric);
}

// What a ray's cone covers of a triangle: metres across, and twice the triangle's area in world space.
struct SceneCone {
    float metres;
    float area;
};

// The mip level that the cone asks for.
float sceneLevel(SceneCorners t, GpuTexture image, SceneCone cone) {
    if (cone.metres <= 0.0 || image.levels == 1) return 0.0;
    const CornerUvs uvs = sceneUvs(t, textureUvSet(image.flags));
    const float texels =
        uvArea(uvs.a, uvs.b, uvs.c) * texelsPerUvArea(image.rowU, image.rowV, image.width, image.height);
    return footprintLevel(cone.metres, texels, cone.area, image.levels);
}

vec3 sceneColor(SceneCorners t, int texture, SceneCone cone) {
    const GpuTexture image = sceneTexture(texture);
    return textureColor(image, sceneUv(t, image), sceneLevel(t, image, cone));
}

vec3 sceneTexel(SceneCorners t, int texture, SceneCone cone) {
    const GpuTexture image = sceneTexture(texture);
    return textureData(image, sceneUv(t, image), sceneLevel(t, image, cone));
}

vec4 sceneTangent(SceneCorners t, int uvSet) {
    if (t.mesh.firstTangent >= 0) {
        SceneTangents tangents = SceneTangents(PROBEGI_SCENE.tangents);
        const uint first = uint(t.mesh.firstTangent);
        const vec4 given =
            interpolate(tangents.at[first + t.triangle.vertex.x], tangents.at[first + t.triangle.vertex.y],
                        tangents.at[first + t.triangle.vertex.z], t.barycentric);
        if (given.w != 0.0) return given;
    }
    const CornerUvs uvs = sceneUvs(t, uvSet);
    return tangentFromUvs(t.b.position - t.a.position, t.c.position - t.a.position, uvs.b - uvs.a, uvs.c - uvs.a);
}

// Colours of the front, and of both sides where the material has two.
void sceneShade(inout Surface surface, SceneCorners t, GpuMaterial material, SceneCone cone) {
    surface.metallic = material.metallic;
    surface.roughness = material.roughness;
    surface.albedo = vec3(0.0);
    surface.emission = vec3(0.0);
    if (surface.backface) return;
    vec3 color = vec3(1.0);
    if (material.baseColorTexture >= 0) color = sceneColor(t, material.baseColorTexture, cone);
    surface.albedo = surfaceAlbedo(material.baseColor, color);
    if (material.metallicRoughnessTexture >= 0) {
        const vec3 texel = sceneTexel(t, material.metallicRoughnessTexture, cone);
        surface.metallic = surfaceMetallic(material.metallic, texel);
        surface.roughness = surfaceRoughness(material.roughness, texel);
    }
    surface.emission = material.emission;
    if (material.emissiveTexture >= 0) surface.emission *= sceneColor(t, material.emissiveTexture, cone);
}

SceneCorners sceneCorners(Hit hit) {
    SceneCorners t;
    t.mesh = sceneMesh(hit.instance, hit.geometry);
    t.triangle = sceneTriangle(t.mesh, hit.primitive);
    t.a = sceneVertex(t.mesh, t.triangle.vertex.x);
    t.b = sceneVertex(t.mesh, t.triangle.vertex.y);
    t.c = sceneVertex(t.mesh, t.triangle.vertex.z);
    t.barycentric = hit.barycentric;
    return t;
}

// Resolves a hit that closestHit() found along the ray. `spread`: angle of the ray's cone in radians, by which textures
// are filtered; 0: not at all.
Surface surfaceAt(Ray ray, Hit hit, float spread) {
    const SceneCorners t = sceneCorners(hit);
    const GpuMaterial material = sceneMaterial(t.triangle.material);
    vec3 position = interpolate(t.a.position, t.b.position, t.c.position, t.barycentric);
    vec3 edgeCross = cross(t.b.position - t.a.position, t.c.position - t.a.position);
    float area = length(edgeCross);
    vec3 normal = interpolate(t.a.normal, t.b.normal, t.c.normal, t.barycentric);
    mat4x3 toWorld;
    if (hit.instance >= 0) {
        SceneInstances instances = SceneInstances(PROBEGI_SCENE.instances);
        toWorld = instances.at[hit.instance].toWorld;
        const mat3 normalToWorld = instances.at[hit.instance].normalToWorld;
        const mat3 linear = mat3(toWorld);
        area = length(cross(linear * (t.b.position - t.a.position), linear * (t.c.position - t.a.position)));
        position = toWorld * vec4(position, 1.0);
        edgeCross = placeNormal(normalToWorld, edgeCross);
        normal = placeNormal(normalToWorld, normal);
    }
    FrontNormals front = frontNormals(edgeCross, normal, -ray.direction);
    const SceneCone cone = SceneCone(coneFootprint(spread, hit.distance, dot(front.geometric, ray.direction)), area);
    if (material.normalTexture >= 0) {
        vec4 tangent = sceneTangent(t, textureUvSet(sceneTexture(material.normalTexture).flags));
        if (hit.instance >= 0) tangent = placeTangent(mat3(toWorld), tangent);
        const vec3 texel = sceneTexel(t, material.normalTexture, cone);
        front.shading = mapNormal(texel, material.normalScale, tangent, front.shading);
    }
    const FrontNormals facing = facingNormals(front, ray.direction);
    Surface surface;
    surface.position = position;
    surface.geometricNormal = facing.geometric;
    surface.shadingNormal = facing.shading;
    surface.material = int(t.triangle.material);
    surface.back = meetsBack(front, ray.direction);
    surface.backface = surface.back && material.doubleSided == 0;
    sceneShade(surface, t, material, cone);
    return surface;
}

Surface surfaceAt(Ray ray, Hit hit) {
    return surfaceAt(ray, hit, 0.0);
}

// Whether a candidate hit on a masked mesh counts; on an opaque one all do.
bool alphaPasses(int instance, int geometry, int primitive, vec2 barycentric) {
    if (geometry != kGeometryMasked) return true;
    const GpuMesh mesh = sceneMesh(instance, geometry);
    const GpuTriangle triangle = sceneTriangle(mesh, primitive);
    const GpuMaterial material = sceneMaterial(triangle.material);
    if (material.baseColorTexture < 0) return material.textureAlphaCutoff <= 1.0;
    const GpuTexture image = sceneTexture(material.baseColorTexture);
    CornerUvs uvs;
    if (textureUvSet(image.flags) == 0)
        uvs = CornerUvs(sceneVertex(mesh, triangle.vertex.x).uv, sceneVertex(mesh, triangle.vertex.y).uv,
                        sceneVertex(mesh, triangle.vertex.z).uv);
    else
        uvs = sceneSecondUvs(mesh, triangle);
    return textureAlpha(image, interpolate(uvs.a, uvs.b, uvs.c, barycentric)) >= material.textureAlphaCutoff;
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
