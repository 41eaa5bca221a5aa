#include "sdf/solid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace probegi {

static_assert(int(SdfShape::box) == int(kernels::kSdfBox) &&
              int(SdfShape::roundedBox) == int(kernels::kSdfRoundedBox) &&
              int(SdfShape::sphere) == int(kernels::kSdfSphere) &&
              int(SdfShape::capsule) == int(kernels::kSdfCapsule) &&
              int(SdfShape::cylinder) == int(kernels::kSdfCylinder) && int(SdfShape::plane) == int(kernels::kSdfPlane));
static_assert(sizeof(kernels::SdfSolid) == kSdfPrimitiveBytes);

kernels::SdfSolid makeSolid(const SdfPrimitive& primitive, const glm::mat4& frame) {
    const float scale = glm::length(glm::vec3(frame[0]));
    glm::quat rotation = primitive.rotation;
    if (frame != glm::mat4(1.0f)) {
        glm::mat3 axes = glm::mat3(frame) / scale * glm::mat3_cast(rotation);
        // Mirrored, as no rotation is; but all shapes are their own mirror images along x.
        if (glm::determinant(axes) < 0) axes[0] = -axes[0];
        rotation = glm::quat_cast(axes);
    }
    rotation = glm::normalize(rotation);
    kernels::SdfSolid solid;
    solid.centre = glm::vec3(frame * glm::vec4(primitive.centre, 1.0f));
    solid.shape = kernels::uint(primitive.shape);
    solid.rotation = {rotation.x, rotation.y, rotation.z, rotation.w};
    solid.halfSize = primitive.halfSize * scale;
    solid.rounding = primitive.shape == SdfShape::roundedBox ? primitive.rounding * scale : 0.0f;
    return solid;
}

glm::vec3 halfExtents(const kernels::SdfSolid& solid) {
    const glm::vec3 h = solid.halfSize;
    if (solid.shape == kernels::kSdfSphere) return glm::vec3(h.x);
    if (solid.shape == kernels::kSdfCapsule) return {h.x, h.y + h.x, h.x};
    if (solid.shape == kernels::kSdfCylinder) return {h.x, h.y, h.x};
    return solid.shape == kernels::kSdfPlane ? glm::vec3(kernels::kSdfFar) : h;
}

}  // namespace probegi
