// The packed scene's triangles, for every tracer that hits them: what a hit looks like, and which candidate hits count.
#ifndef PROBEGI_VULKAN_TRIANGLES_GLSL
#define PROBEGI_VULKAN_TRIANGLES_GLSL

#include "vulkan/shaders/scene.glsl"

#include "kernels/shade/surface.h"

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

// Of the second set.
vec2 sceneSecondUv(GpuMesh mesh, uint vertex) {
    if (mesh.firstUv1 < 0) return vec2(0.0);
    return SceneUvs(PROBEGI_SCENE.uv1).at[uint(mesh.firstUv1) + vertex];
}

// What kernels/shade/resolve_surface.h asks of a hit.
struct HitAccess {
    GpuMesh mesh;
    GpuTriangle triangle;
    GpuVertex corners[3];
    GpuMaterial material;
    int materialIndex;
    vec2 barycentric;
    bool placed;
    mat4x3 toWorld;
    mat3 normalToWorld;
};
#define SurfaceTexture GpuTexture

vec3 cornerPosition(HitAccess hit, int corner) {
    return hit.corners[corner].position;
}
vec3 cornerNormal(HitAccess hit, int corner) {
    return hit.corners[corner].normal;
}
vec2 cornerUv(HitAccess hit, int corner, int uvSet) {
    if (uvSet == 0) return hit.corners[corner].uv;
    return sceneSecondUv(hit.mesh, hit.triangle.vertex[corner]);
}
bool hasTangents(HitAccess hit) {
    return hit.mesh.firstTangent >= 0;
}
vec4 cornerTangent(HitAccess hit, int corner) {
    return SceneTangents(PROBEGI_SCENE.tangents).at[uint(hit.mesh.firstTangent) + hit.triangle.vertex[corner]];
}

bool isTexture(HitAccess hit, int texture) {
    return texture >= 0;
}
GpuTexture openTexture(HitAccess hit, int texture) {
    return sceneTexture(texture);
}
int textureUvSet(HitAccess hit, GpuTexture image) {
    return textureUvSet(image.flags);
}
int textureLevels(HitAccess hit, GpuTexture image) {
    return image.levels;
}
float textureDensity(HitAccess hit, GpuTexture image) {
    return texelsPerUvArea(image.rowU, image.rowV, image.width, image.height);
}
vec3 textureColor(HitAccess hit, GpuTexture image, vec2 uv, float level) {
    return textureColor(image, uv, level);
}
vec3 textureData(HitAccess hit, GpuTexture image, vec2 uv, float level) {
    return textureData(image, uv, level);
}

#include "kernels/shade/resolve_surface.h"

// Resolves a hit that closestHit() found along the ray. `spread`: angle of the ray's cone in radians, by which textures
// are filtered; 0: not at all.
Surface surfaceAt(Ray ray, Hit hit, float spread) {
    HitAccess access;
    access.mesh = sceneMesh(hit.instance, hit.geometry);
    access.triangle = sceneTriangle(access.mesh, hit.primitive);
    access.corners[0] = sceneVertex(access.mesh, access.triangle.vertex.x);
    access.corners[1] = sceneVertex(access.mesh, access.triangle.vertex.y);
    access.corners[2] = sceneVertex(access.mesh, access.triangle.vertex.z);
    access.materialIndex = int(access.triangle.material);
    access.material = sceneMaterial(access.triangle.material);
    access.barycentric = hit.barycentric;
    access.placed = hit.instance >= 0;
    if (access.placed) {
        SceneInstances instances = SceneInstances(PROBEGI_SCENE.instances);
        access.toWorld = instances.at[hit.instance].toWorld;
        access.normalToWorld = instances.at[hit.instance].normalToWorld;
    }
    return resolveSurface(access, ray.direction, hit.distance, spread);
}

// Whether a candidate hit on a masked mesh counts; on an opaque one all do.
bool alphaPasses(int instance, int geometry, int primitive, vec2 barycentric) {
    if (geometry != kGeometryMasked) return true;
    const GpuMesh mesh = sceneMesh(instance, geometry);
    const GpuTriangle triangle = sceneTriangle(mesh, primitive);
    const GpuMaterial material = sceneMaterial(triangle.material);
    if (material.baseColorTexture < 0) return material.textureAlphaCutoff <= 1.0;
    const GpuTexture image = sceneTexture(material.baseColorTexture);
    vec2 uv[3];
    for (int corner = 0; corner < 3; ++corner) {
        const uint vertex = triangle.vertex[corner];
        if (textureUvSet(image.flags) == 0)
            uv[corner] = sceneVertex(mesh, vertex).uv;
        else
            uv[corner] = sceneSecondUv(mesh, vertex);
    }
    return textureAlpha(image, interpolate(uv[0], uv[1], uv[2], barycentric)) >= material.textureAlphaCutoff;
}

#endif
