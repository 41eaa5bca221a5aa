#pragma once

#include <span>
#include <string>
#include <vector>

#include "kernels/sdf/primitive.h"
#include "probegi/sdf.h"
#include "sdf/fit/fit_rays.h"

namespace probegi {

/// Gives each primitive, all of them boxes but for the fixed ones, the mean colour, by texels of its faces and overall,
/// and the mean emission of the scene's surface that it stands for, by the rays that meet
/// both within `near` metres of each other across the surface, and a name after the material of most of it. `solids`
/// are those of `primitives`, of which the first `fixed` are left alone. Primitives that no ray meets go last; those
/// before them are in the order of the rays that meet them.
void giveLooks(std::vector<SdfPrimitive>& primitives, std::span<const kernels::SdfSolid> solids, std::size_t fixed,
               const FitRays& walked, float near, const Scene& scene);

}  // namespace probegi
