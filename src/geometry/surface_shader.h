#pragma once

#include "geometry/surface_mesh.h"
#include "probegi/tracer.h"

namespace probegi {

/// Shades a hit on a mesh, in the mesh's own space (origin and direction too).
/// Normals: interpolated, then normal-mapped, on the geometric normal's side; then both are flipped towards the ray's
/// origin. A shading normal that still faces away is bent to just above grazing, so that every BSDF is defined.
/// `spread`: angle of the ray's cone in radians, for texture filtering if the materials have mip levels.
Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, float spread = 0) noexcept;

/// The same for a mesh placed by a transform; direction is in world space.
Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, const glm::mat4& toWorld, const glm::mat3& normalToWorld,
                 float spread = 0) noexcept;

/// Prefetches what shadeHit() reads of the hit's triangle and its base colour.
void fetchAhead(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit) noexcept;

/// Interpolated uv of the given set.
glm::vec2 interpolateUv(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, glm::vec2 barycentric,
                        int texCoord) noexcept;

}  // namespace probegi
