#pragma once

#include <span>
#include <vector>

#include "probegi/field.h"

namespace probegi::tool {

/// Camera rays through the pixels' centres, row by row.

/// The queries of a picture's hits, in the order of its rays. Errors: those of the tracer.
Result<std::vector<FieldQuery>> picturePoints(const Tracer& tracer, std::span<const Ray> rays);

}  // namespace probegi::tool
