#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "geometry/surface_material.h"

namespace probegi {

/// Vertex data that nearly every hit reads, in half a cache line. The ray tracer reads positions from here too.
struct alignas(32) SurfaceVertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit; zero: the mesh has none
    glm::vec2 uv{0.0f};
};
static_assert(sizeof(SurfaceVertex) == 32);

struct alignas(16) SurfaceTriangle {
    std::uint32_t vertex[3];
    std::uint32_t material;
};
static_assert(sizeof(SurfaceTriangle) == 16);

/// Triangles of any number of primitives in one index space. Rarely read attributes are separate; they are empty or as
/// long as the vertices.
struct SurfaceMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<SurfaceTriangle> triangles;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> tangents;  ///< zero: derived from the uvs

    bool empty() const noexcept { return triangles.empty(); }
};

/// Triangles in the same space, split by the cost of a candidate hit.
struct SurfaceGroup {
    SurfaceMesh opaque;
    SurfaceMesh masked;

    static constexpr int kOpaque = 0;  ///< geometry numbers, as in Hit::geometry
    static constexpr int kMasked = 1;
    const SurfaceMesh& mesh(int geometry) const noexcept { return geometry == kMasked ? masked : opaque; }
    bool empty() const noexcept { return opaque.empty() && masked.empty(); }
    Bounds bounds() const noexcept;  ///< of all triangles' vertices; zero-sized if there are none
};

/// Matrix for normals of a given transform: inverse transpose up to a positive factor, also valid for mirroring and
/// singular transforms.
glm::mat3 normalMatrix(const glm::mat4& toWorld);

/// Appends a mesh, transformed. A mirroring transform swaps the winding, so that the front stays the front.
void appendMesh(SurfaceGroup& group, const Mesh& mesh, const glm::mat4& transform,
                std::span<const SurfaceMaterial> materials);

}  // namespace probegi
