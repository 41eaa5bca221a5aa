#include "surface/surface_shader.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace probegi {

namespace {

/// Least cosine between the shading normal and the direction to the ray's origin.
constexpr float kLeastCosine = 1e-3f;

glm::vec3 unitOr(glm::vec3 v, glm::vec3 fallback) {
    const float square = glm::dot(v, v);
    return square > 1e-30f && square < 1e30f ? v * (1.0f / std::sqrt(square)) : fallback;
}

template <class T>
T interpolate(const T& a, const T& b, const T& c, glm::vec2 barycentric) {
    return (1.0f - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c;
}

/// A triangle's corners in the space that is shaded in, and where on it the hit is.
struct Corners {
    const SurfaceVertex& a;
    const SurfaceVertex& b;
    const SurfaceVertex& c;
    glm::vec2 barycentric;
};

glm::vec2 cornerUv(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, int corner, int texCoord) {
    const std::uint32_t vertex = triangle.vertex[corner];
    if (texCoord == 0) return mesh.vertices[vertex].uv;
    return mesh.uv1.empty() ? glm::vec2(0.0f) : mesh.uv1[vertex];
}

/// Tangent along the uvs' u direction, w = side of the bitangent; zero where the uvs are degenerate.
glm::vec4 tangentFromUvs(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, const Corners& t, int texCoord) {
    const glm::vec2 uv = cornerUv(mesh, triangle, 0, texCoord);
    const glm::vec2 d1 = cornerUv(mesh, triangle, 1, texCoord) - uv;
    const glm::vec2 d2 = cornerUv(mesh, triangle, 2, texCoord) - uv;
    const float area = d1.x * d2.y - d2.x * d1.y;
    // glTF's v axis points down in the image while the bitangent points up in it, hence the opposite sign.
    const float side = area < 0.0f ? 1.0f : -1.0f;
    const float orientation = area < 0.0f ? -1.0f : 1.0f;
    const glm::vec3 e1 = t.b.position - t.a.position;
    const glm::vec3 e2 = t.c.position - t.a.position;
    return {orientation * (d2.y * e1 - d1.y * e2), side};
}

glm::vec4 meshTangent(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, const Corners& t, int texCoord) {
    if (!mesh.tangents.empty()) {
        const glm::vec4 given = interpolate(mesh.tangents[triangle.vertex[0]], mesh.tangents[triangle.vertex[1]],
                                            mesh.tangents[triangle.vertex[2]], t.barycentric);
        if (given.w != 0.0f) return given;
    }
    return tangentFromUvs(mesh, triangle, t, texCoord);
}

/// Normal map of glTF 2.0, section 3.9.3: (2c - 1) with xy scaled, in the frame (tangent, bitangent, normal).
glm::vec3 mapNormal(const SurfaceMaterial& material, glm::vec2 uv, glm::vec4 tangent, glm::vec3 normal) {
    const glm::vec3 t = unitOr(glm::vec3(tangent) - normal * glm::dot(normal, glm::vec3(tangent)), glm::vec3(0.0f));
    const glm::vec3 bitangent = glm::cross(normal, t) * (tangent.w < 0.0f ? -1.0f : 1.0f);
    glm::vec3 local = 2.0f * material.normalTexture.data(uv) - 1.0f;
    local.x *= material.normalScale;
    local.y *= material.normalScale;
    return unitOr(local.x * t + local.y * bitangent + local.z * normal, normal);
}

/// A normal that faces the ray's origin: where it does not, the least amount of the direction to the origin is added.
glm::vec3 bendTowards(glm::vec3 normal, glm::vec3 toOrigin) {
    const float cosine = glm::dot(normal, toOrigin);
    if (cosine >= kLeastCosine) return normal;
    return unitOr(normal + (kLeastCosine - cosine) * toOrigin, toOrigin);
}

void shadeMaterial(Surface& surface, const SurfaceMesh& mesh, const SurfaceTriangle& triangle,
                   const SurfaceMaterial& material, glm::vec2 barycentric) {
    surface.metallic = material.metallic;
    surface.roughness = material.roughness;
    surface.albedo = glm::vec3(0.0f);
    surface.emission = glm::vec3(0.0f);
    if (surface.backface) return;
    const auto uv = [&](const TextureSampler& texture) {
        return interpolateUv(mesh, triangle, barycentric, texture.texCoord());
    };
    surface.albedo = material.baseColor;
    if (material.baseColorTexture.present())
        surface.albedo *= material.baseColorTexture.color(uv(material.baseColorTexture));
    surface.albedo = glm::clamp(surface.albedo, 0.0f, 1.0f);
    if (material.metallicRoughnessTexture.present()) {
        const glm::vec3 texel = material.metallicRoughnessTexture.data(uv(material.metallicRoughnessTexture));
        surface.metallic *= texel.z;
        surface.roughness *= texel.y;
    }
    if (material.emissive()) {
        surface.emission = material.emission;
        if (material.emissiveTexture.present())
            surface.emission *= material.emissiveTexture.color(uv(material.emissiveTexture));
    }
}

Surface shade(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, const SurfaceMaterial& material,
              const Corners& t, const glm::mat4* toWorld, const glm::mat3* normalToWorld, glm::vec3 direction) {
    const glm::vec3 toOrigin = -direction;
    glm::vec3 position = interpolate(t.a.position, t.b.position, t.c.position, t.barycentric);
    glm::vec3 geometric = glm::cross(t.b.position - t.a.position, t.c.position - t.a.position);
    glm::vec3 normal = interpolate(t.a.normal, t.b.normal, t.c.normal, t.barycentric);
    if (toWorld) {
        position = glm::vec3(*toWorld * glm::vec4(position, 1.0f));
        geometric = *normalToWorld * unitOr(geometric, glm::vec3(0.0f));
        normal = *normalToWorld * unitOr(normal, glm::vec3(0.0f));
    }
    geometric = unitOr(geometric, toOrigin);
    normal = unitOr(normal, geometric);
    // The winding decides which side is the front (glTF 2.0, section 3.7.2.1); some meshes' normals disagree.
    if (glm::dot(normal, geometric) < 0.0f) normal = -normal;
    if (material.normalMapped()) {
        const int set = material.normalTexture.texCoord();
        glm::vec4 tangent = meshTangent(mesh, triangle, t, set);
        if (toWorld) {
            const glm::mat3 linear(*toWorld);
            const float side = glm::determinant(linear) < 0.0f ? -tangent.w : tangent.w;
            tangent = glm::vec4(linear * glm::vec3(tangent), side);
        }
        normal = mapNormal(material, interpolateUv(mesh, triangle, t.barycentric, set), tangent, normal);
    }
    const bool away = glm::dot(geometric, direction) > 0.0f;
    Surface surface;
    surface.position = position;
    surface.material = std::int32_t(triangle.material);
    surface.geometricNormal = away ? -geometric : geometric;
    surface.shadingNormal = bendTowards(away ? -normal : normal, toOrigin);
    surface.backface = away && !material.doubleSided;
    surface.material = std::int32_t(triangle.material);
    shadeMaterial(surface, mesh, triangle, material, t.barycentric);
    return surface;
}

Surface shadeTriangle(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                      const glm::mat4* toWorld, const glm::mat3* normalToWorld, glm::vec3 direction) {
    const SurfaceTriangle& triangle = mesh.triangles[std::size_t(hit.primitive)];
    const Corners corners{mesh.vertices[triangle.vertex[0]], mesh.vertices[triangle.vertex[1]],
                          mesh.vertices[triangle.vertex[2]], hit.barycentric};
    return shade(mesh, triangle, materials[triangle.material], corners, toWorld, normalToWorld, direction);
}

}  // namespace

glm::vec2 interpolateUv(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, glm::vec2 barycentric,
                        int texCoord) noexcept {
    return interpolate(cornerUv(mesh, triangle, 0, texCoord), cornerUv(mesh, triangle, 1, texCoord),
                       cornerUv(mesh, triangle, 2, texCoord), barycentric);
}

Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction) noexcept {
    return shadeTriangle(mesh, materials, hit, nullptr, nullptr, direction);
}

Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, const glm::mat4& toWorld, const glm::mat3& normalToWorld) noexcept {
    return shadeTriangle(mesh, materials, hit, &toWorld, &normalToWorld, direction);
}

}  // namespace probegi
