#include "geometry/surface_mesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace probegi {

namespace {

glm::vec3 unitOrZero(glm::vec3 v) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length) ? v / length : glm::vec3(0.0f);
}

void appendVertices(SurfaceMesh& mesh, const Primitive& primitive, const glm::mat4& transform) {
    const glm::mat3 normals = normalMatrix(transform);
    const bool hasNormals = !primitive.normals.empty();
    const bool hasUv = !primitive.uv0.empty();
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        SurfaceVertex vertex;
        vertex.position = glm::vec3(transform * glm::vec4(primitive.positions[i], 1.0f));
        if (hasNormals) vertex.normal = unitOrZero(normals * primitive.normals[i]);
        if (hasUv) vertex.uv = primitive.uv0[i];
        mesh.vertices.push_back(vertex);
    }
}

void appendTangents(SurfaceMesh& mesh, std::size_t base, const Primitive& primitive, const glm::mat4& transform) {
    const glm::mat3 linear(transform);
    const float handedness = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;
    mesh.tangents.resize(base);
    for (const glm::vec4& tangent : primitive.tangents)
        mesh.tangents.emplace_back(unitOrZero(linear * glm::vec3(tangent)), handedness * tangent.w);
}

void appendTriangles(SurfaceMesh& mesh, std::size_t base, const Primitive& primitive, bool mirrored) {
    const auto offset = std::uint32_t(base);
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        SurfaceTriangle triangle{
            {offset + primitive.indices[i], offset + primitive.indices[i + 1], offset + primitive.indices[i + 2]},
            std::uint32_t(primitive.material)};
        if (mirrored) std::swap(triangle.vertex[1], triangle.vertex[2]);
        mesh.triangles.push_back(triangle);
    }
}

void grow(Bounds& bounds, const SurfaceMesh& mesh) {
    for (const SurfaceTriangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle.vertex) {
            bounds.lower = glm::min(bounds.lower, mesh.vertices[vertex].position);
            bounds.upper = glm::max(bounds.upper, mesh.vertices[vertex].position);
        }
    }
}

}  // namespace

Bounds SurfaceGroup::bounds() const noexcept {
    if (empty()) return {};
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    grow(bounds, opaque);
    grow(bounds, masked);
    return bounds;
}

glm::mat3 normalMatrix(const glm::mat4& toWorld) {
    // The cofactor matrix maps cross products: M a x M b = cof(M) (a x b). It is the inverse transpose times det(M).
    const glm::vec3 x(toWorld[0]), y(toWorld[1]), z(toWorld[2]);
    const glm::mat3 cofactor(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    return glm::dot(cofactor[0], x) < 0.0f ? -cofactor : cofactor;
}

void appendMesh(SurfaceGroup& group, const Mesh& mesh, const glm::mat4& transform,
                std::span<const SurfaceMaterial> materials) {
    const bool mirrored = glm::determinant(glm::mat3(transform)) < 0.0f;
    for (const Primitive& primitive : mesh.primitives) {
        const SurfaceMaterial& material = materials[std::size_t(primitive.material)];
        if (material.opacity == Opacity::absent || primitive.indices.empty()) continue;
        SurfaceMesh& target = material.opacity == Opacity::masked ? group.masked : group.opaque;
        const std::size_t base = target.vertices.size();
        appendVertices(target, primitive, transform);
        appendTriangles(target, base, primitive, mirrored);
        if (material.usesSecondUv() && !primitive.uv1.empty()) {
            target.uv1.resize(base);
            target.uv1.insert(target.uv1.end(), primitive.uv1.begin(), primitive.uv1.end());
        }
        if (material.normalMapped() && !primitive.tangents.empty()) appendTangents(target, base, primitive, transform);
        if (!target.uv1.empty()) target.uv1.resize(target.vertices.size());
        if (!target.tangents.empty()) target.tangents.resize(target.vertices.size());
    }
}

}  // namespace probegi
