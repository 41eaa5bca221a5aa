#pragma once

#include "geometry/surface_mesh.h"
#include "probegi/tracer.h"

namespace probegi {

/// Turns one hit on a mesh into a Surface, in the mesh's own space (origin and direction too).
/// Normals: interpolated, then normal-mapped, on the geometric normal's side; then both turn to the ray's origin. A
/// shading normal that would still face away from the ray is bent to just above grazing, so that every BSDF is defined.
/// `spread`: angle of the ray's cone in radians, by which textures are filtered where the materials have mip levels.
Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, float spread = 0) noexcept;

/// The same for a mesh placed by a transform; direction is in world space.
Surface shadeHit(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit,
                 glm::vec3 direction, const glm::mat4& toWorld, const glm::mat3& normalToWorld,
                 float spread = 0) noexcept;

/// Asks the caches for what shadeHit() will read of the hit's triangle and its base colour.
void fetchAhead(const SurfaceMesh& mesh, std::span<const SurfaceMaterial> materials, const Hit& hit) noexcept;

/// Interpolated uv of the given set.
glm::vec2 interpolateUv(const SurfaceMesh& mesh, const SurfaceTriangle& triangle, glm::vec2 barycentric,
                        int texCoord) noexcept;

}  // namespace probegi
