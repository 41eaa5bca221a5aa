// The packed scene's triangles, for every tracer that hits them: what a hit looks like, and which candidate hits count.
// The same steps as src/geometry/surface_shader.cpp, on the same formulas.
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

#endif
