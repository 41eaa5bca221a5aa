#pragma once

#include <span>

#include "kernels/sdf/primitive.h"
#include "probegi/sdf_fit.h"
#include "sdf/fit/fit_rays.h"

namespace probegi {

/// Where a ray from air enters the union of solids, metres; 0: it starts inside; kFitSky: nowhere. `number`: of the
/// solid that it meets, -1: none.
float entersUnion(std::span<const kernels::SdfSolid> solids, const FitRay& ray, int& number) noexcept;

/// The accuracy by given rays, and the light where each starts, as of lightOfStarts(). Errors: the tracer's.
Result<SdfAccuracy> accuracyBy(const Context& context, const Tracer& tracer, std::span<const FitRay> rays,
                               std::span<const float> light, std::span<const kernels::SdfSolid> solids);

}  // namespace probegi
