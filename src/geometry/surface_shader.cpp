#include "geometry/surface_shader.h"

#include "kernels/shade/resolve_surface.h"

namespace probegi {

namespace {

glm::vec2 uvOf(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, int corner, int set) {
    const std::uint32_t vertex = triangle.vertex[corner];
    if (set == 0) return mesh.vertices[vertex].uv;
    return mesh.uv1.empty() ? glm::vec2(0.0f) : mesh.uv1[vertex];
}

/// What kernels/shade/resolve_surface.h asks of a hit.
struct MeshHit {
    using Surface = probegi::Surface;
    using SurfaceTexture = TextureSampler;

    const SurfaceMesh& mesh;
    const SurfaceTriangle& triangle;
    const SurfaceVertex* corners[3];
    const SurfaceMaterial& material;
    int materialIndex;
    glm::vec2 barycentric;
    bool placed;
    const glm::mat4& toWorld;
    const glm::mat3& normalToWorld;
};

const glm::vec3& cornerPosition(const MeshHit& hit, int corner) {
    return hit.corners[corner]->position;
}
const glm::vec3& cornerNormal(const MeshHit& hit, int corner) {
    return hit.corners[corner]->normal;
}
glm::vec2 cornerUv(const MeshHit& hit, int corner, int set) {
    return uvOf(hit.mesh, hit.triangle, corner, set);
}
bool hasTangents(const MeshHit& hit) {
    return !hit.mesh.tangents.empty();
}
const glm::vec4& cornerTangent(const MeshHit& hit, int corner) {
    return hit.mesh.tangents[hit.triangle.vertex[corner]];
}

bool isTexture(const MeshHit&, const TextureSampler& texture) {
    return texture.present();
}
const TextureSampler& openTexture(const MeshHit&, const TextureSampler& texture) {
    return texture;
}
int textureUvSet(const MeshHit&, const TextureSampler& texture) {
    return texture.texCoord();
}
int textureLevels(const MeshHit&, const TextureSampler& texture) {
    return texture.levels();
}
float textureDensity(const MeshHit&, const TextureSampler& texture) {
    return texture.texelsPerUvArea();
}
glm::vec3 textureColor(const MeshHit&, const TextureSampler& texture, glm::vec2 uv, float level) {
    return level > 0 ? texture.color(uv, level) : texture.color(uv);
}
glm::vec3 textureData(const MeshHit&, const TextureSampler& texture, glm::vec2 uv, float level) {
    return level > 0 ? texture.data(uv, level) : texture.data(uv);
}

// Of what is not placed.
const glm::mat4 kNowhere(1.0f);
const glm::mat3 kNoNormals(1.0f);

Surface shadeTriangle(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit, bool placed,
                      const glm::mat4& toWorld, const glm::mat3& normalToWorld, glm::vec3 direction, float spread) {
    const SurfaceTriangle& triangle = mesh.triangles[std::size_t(hit.primitive)];
    const SurfaceVertex* vertices = mesh.vertices.data();
    const MeshHit access{mesh,
                         triangle,
                         {vertices + triangle.vertex[0], vertices + triangle.vertex[1], vertices + triangle.vertex[2]},
                         materials[triangle.material],
                         std::int32_t(triangle.material),
                         hit.barycentric,
                         placed,
                         toWorld,
                         normalToWorld};
    return kernels::resolveSurface(access, direction, hit.distance, spread);
}

}  // namespace

glm::vec2 interpolateUv(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, glm::vec2 barycentric,
                        int texCoord) noexcept {
    return kernels::interpolate(uvOf(mesh, triangle, 0, texCoord), uvOf(mesh, triangle, 1, texCoord),
                                uvOf(mesh, triangle, 2, texCoord), barycentric);
}

void fetchAhead(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit) noexcept {
    const SurfaceTriangle& triangle = mesh.triangles[std::size_t(hit.primitive)];
    const TextureSampler& texture = materials[triangle.material].baseColorTexture;
    texture.fetchAhead(interpolateUv(mesh, triangle, hit.barycentric, texture.texCoord()));
}

Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, float spread) noexcept {
    return shadeTriangle(mesh, materials, hit, false, kNowhere, kNoNormals, direction, spread);
}

Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, const glm::mat4& toWorld, const glm::mat3& normalToWorld, float spread) noexcept {
    return shadeTriangle(mesh, materials, hit, true, toWorld, normalToWorld, direction, spread);
}

}  // namespace probegi
