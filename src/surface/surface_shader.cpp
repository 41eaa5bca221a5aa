#include "surface/surface_shader.h"

#include <glm/geometric.hpp>

#include "kernels/surface.h"

namespace probegi {

namespace {

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

glm::vec4 derivedTangent(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, const Corners& t, int texCoord) {
    const glm::vec2 uv = cornerUv(mesh, triangle, 0, texCoord);
    return kernels::tangentFromUvs(t.b.position - t.a.position, t.c.position - t.a.position,
                                   cornerUv(mesh, triangle, 1, texCoord) - uv,
                                   cornerUv(mesh, triangle, 2, texCoord) - uv);
}

glm::vec4 meshTangent(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, const Corners& t, int texCoord) {
    if (!mesh.tangents.empty()) {
        const glm::vec4 given =
            kernels::interpolate(mesh.tangents[triangle.vertex[0]], mesh.tangents[triangle.vertex[1]],
                                 mesh.tangents[triangle.vertex[2]], t.barycentric);
        if (given.w != 0.0f) return given;
    }
    return derivedTangent(mesh, triangle, t, texCoord);
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
    glm::vec3 color(1.0f);
    if (material.baseColorTexture.present()) color = material.baseColorTexture.color(uv(material.baseColorTexture));
    surface.albedo = kernels::surfaceAlbedo(material.baseColor, color);
    if (material.metallicRoughnessTexture.present()) {
        const glm::vec3 texel = material.metallicRoughnessTexture.data(uv(material.metallicRoughnessTexture));
        surface.metallic = kernels::surfaceMetallic(material.metallic, texel);
        surface.roughness = kernels::surfaceRoughness(material.roughness, texel);
    }
    if (material.emissive()) {
        surface.emission = material.emission;
        if (material.emissiveTexture.present())
            surface.emission *= material.emissiveTexture.color(uv(material.emissiveTexture));
    }
}

Surface shade(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, const SurfaceMaterial& material,
              const Corners& t, const glm::mat4* toWorld, const glm::mat3* normalToWorld, glm::vec3 direction) {
    glm::vec3 position = kernels::interpolate(t.a.position, t.b.position, t.c.position, t.barycentric);
    glm::vec3 edgeCross = glm::cross(t.b.position - t.a.position, t.c.position - t.a.position);
    glm::vec3 normal = kernels::interpolate(t.a.normal, t.b.normal, t.c.normal, t.barycentric);
    if (toWorld) {
        position = glm::vec3(*toWorld * glm::vec4(position, 1.0f));
        edgeCross = kernels::placeNormal(*normalToWorld, edgeCross);
        normal = kernels::placeNormal(*normalToWorld, normal);
    }
    kernels::FrontNormals front = kernels::frontNormals(edgeCross, normal, -direction);
    if (material.normalMapped()) {
        const int set = material.normalTexture.texCoord();
        glm::vec4 tangent = meshTangent(mesh, triangle, t, set);
        if (toWorld) tangent = kernels::placeTangent(glm::mat3(*toWorld), tangent);
        const glm::vec3 texel = material.normalTexture.data(interpolateUv(mesh, triangle, t.barycentric, set));
        front.shading = kernels::mapNormal(texel, material.normalScale, tangent, front.shading);
    }
    const kernels::FrontNormals facing = kernels::facingNormals(front, direction);
    Surface surface;
    surface.position = position;
    surface.geometricNormal = facing.geometric;
    surface.shadingNormal = facing.shading;
    surface.back = kernels::meetsBack(front, direction);
    surface.backface = surface.back && !material.doubleSided;
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
    return kernels::interpolate(cornerUv(mesh, triangle, 0, texCoord), cornerUv(mesh, triangle, 1, texCoord),
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
