#pragma once

#include <string_view>

#include "probegi/image.h"
#include "probegi/scene.h"
#include "probegi/tracer.h"

namespace probegi::tool {

/// Primitives over the scene that they stand for: each in a colour of its own, shaded by its normal, and through it the
/// scene in grey. White: the scene is there and no primitive. `primitives` traces them, `scene` the triangles. The
/// values are for writeImage at exposure 1. Errors: the tracers'.
Result<HdrImage> drawPrimitives(const Tracer& scene, const Tracer& primitives, const PlacedCamera& camera, int width,
                                int height);

}  // namespace probegi::tool
