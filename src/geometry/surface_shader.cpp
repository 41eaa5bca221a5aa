#include "geometry/surface_shader.h"

#include <glm/geometric.hpp>

#include "kernels/shade/surface.h"
#include "kernels/shade/texture.h"

namespace probegi {

namespace {

/// A triangle's corners in shading space, and the hit's position on it.
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

struct ConeOfRay {
    float spread;    ///< radians; 0: a line
    float distance;  ///< metres to the hit
};

/// Footprint of a ray's cone on a triangle.
struct ConeFootprint {
    float metres = 0;  ///< across
    float area = 0;    ///< of the triangle in world space, twice

    ConeFootprint() = default;
    ConeFootprint(float spread, float distance, float cosine, const Corners& t, const glm::mat4* toWorld)
        : metres(kernels::coneFootprint(spread, distance, cosine)) {
        glm::vec3 edge1 = t.b.position - t.a.position, edge2 = t.c.position - t.a.position;
        if (toWorld) edge1 = glm::mat3(*toWorld) * edge1, edge2 = glm::mat3(*toWorld) * edge2;
        area = glm::length(glm::cross(edge1, edge2));
    }
};

/// Look-ups of a hit's textures.
struct Texels {
    const SurfaceMesh& mesh;
    const SurfaceTriangle& triangle;
    glm::vec2 barycentric;
    ConeFootprint footprint;

    glm::vec2 uv(const TextureSampler& texture) const {
        return interpolateUv(mesh, triangle, barycentric, texture.texCoord());
    }
    float level(const TextureSampler& texture) const {
        if (footprint.metres <= 0 || texture.levels() == 1) return 0;
        const int set = texture.texCoord();
        const float uvArea = kernels::uvArea(cornerUv(mesh, triangle, 0, set), cornerUv(mesh, triangle, 1, set),
                                             cornerUv(mesh, triangle, 2, set));
        return kernels::footprintLevel(footprint.metres, uvArea * texture.texelsPerUvArea(), footprint.area,
                                       texture.levels());
    }
    glm::vec3 color(const TextureSampler& texture) const {
        const float on = level(texture);
        return on > 0 ? texture.color(uv(texture), on) : texture.color(uv(texture));
    }
    glm::vec3 data(const TextureSampler& texture) const {
        const float on = level(texture);
        return on > 0 ? texture.data(uv(texture), on) : texture.data(uv(texture));
    }
};

void shadeMaterial(Surface& surface, const SurfaceMaterial& material, const Texels& texels) {
    surface.metallic = material.metallic;
    surface.roughness = material.roughness;
    surface.albedo = glm::vec3(0.0f);
    surface.emission = glm::vec3(0.0f);
    if (surface.backface) return;
    glm::vec3 color(1.0f);
    if (material.baseColorTexture.present()) color = texels.color(material.baseColorTexture);
    surface.albedo = kernels::surfaceAlbedo(material.baseColor, color);
    if (material.metallicRoughnessTexture.present()) {
        const glm::vec3 texel = texels.data(material.metallicRoughnessTexture);
        surface.metallic = kernels::surfaceMetallic(material.metallic, texel);
        surface.roughness = kernels::surfaceRoughness(material.roughness, texel);
    }
    if (material.emissive()) {
        surface.emission = material.emission;
        if (material.emissiveTexture.present()) surface.emission *= texels.color(material.emissiveTexture);
    }
}

Surface shade(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, const SurfaceMaterial& material,
              const Corners& t, const glm::mat4* toWorld, const glm::mat3* normalToWorld, glm::vec3 direction,
              ConeOfRay cone) {
    glm::vec3 position = kernels::interpolate(t.a.position, t.b.position, t.c.position, t.barycentric);
    glm::vec3 edgeCross = glm::cross(t.b.position - t.a.position, t.c.position - t.a.position);
    glm::vec3 normal = kernels::interpolate(t.a.normal, t.b.normal, t.c.normal, t.barycentric);
    if (toWorld) {
        position = glm::vec3(*toWorld * glm::vec4(position, 1.0f));
        edgeCross = kernels::placeNormal(*normalToWorld, edgeCross);
        normal = kernels::placeNormal(*normalToWorld, normal);
    }
    kernels::FrontNormals front = kernels::frontNormals(edgeCross, normal, -direction);
    Texels texels{mesh, triangle, t.barycentric, {}};
    if (cone.spread > 0)
        texels.footprint = {cone.spread, cone.distance, glm::dot(front.geometric, direction), t, toWorld};
    if (material.normalMapped()) {
        const int set = material.normalTexture.texCoord();
        glm::vec4 tangent = meshTangent(mesh, triangle, t, set);
        if (toWorld) tangent = kernels::placeTangent(glm::mat3(*toWorld), tangent);
        const glm::vec3 texel = texels.data(material.normalTexture);
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
    shadeMaterial(surface, material, texels);
    return surface;
}

Surface shadeTriangle(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                      const glm::mat4* toWorld, const glm::mat3* normalToWorld, glm::vec3 direction, float spread) {
    const SurfaceTriangle& triangle = mesh.triangles[std::size_t(hit.primitive)];
    const Corners corners{mesh.vertices[triangle.vertex[0]], mesh.vertices[triangle.vertex[1]],
                          mesh.vertices[triangle.vertex[2]], hit.barycentric};
    return shade(mesh, triangle, materials[triangle.material], corners, toWorld, normalToWorld, direction,
                 {spread, hit.distance});
}

}  // namespace

glm::vec2 interpolateUv(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, glm::vec2 barycentric,
                        int texCoord) noexcept {
    return kernels::interpolate(cornerUv(mesh, triangle, 0, texCoord), cornerUv(mesh, triangle, 1, texCoord),
                                cornerUv(mesh, triangle, 2, texCoord), barycentric);
}

void fetchAhead(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit) noexcept {
    const SurfaceTriangle& triangle = mesh.triangles[std::size_t(hit.primitive)];
    const TextureSampler& texture = materials[triangle.material].baseColorTexture;
    texture.fetchAhead(interpolateUv(mesh, triangle, hit.barycentric, texture.texCoord()));
}

Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, float spread) noexcept {
    return shadeTriangle(mesh, materials, hit, nullptr, nullptr, direction, spread);
}

Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, const glm::mat4& toWorld, const glm::mat3& normalToWorld, float spread) noexcept {
    return shadeTriangle(mesh, materials, hit, &toWorld, &normalToWorld, direction, spread);
}

}  // namespace probegi
