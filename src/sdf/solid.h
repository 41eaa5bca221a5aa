#pragma once

#include "kernels/sdf/primitive.h"
#include "probegi/sdf.h"

namespace probegi {

/// The primitive's geometry as kernels take it, where `frame` is the transform of the node on which it rides: turned,
/// moved and scaled alike along all axes (identity for one that stands in the world).
kernels::SdfSolid makeSolid(const SdfPrimitive& primitive, const glm::mat4& frame = glm::mat4(1.0f));

/// Half the extents of a shape along its frame's axes, metres; of a plane 1e30.
glm::vec3 halfExtents(const kernels::SdfSolid& solid);

}  // namespace probegi
