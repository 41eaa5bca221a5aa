#include <algorithm>

#include "probegi/sdf.h"
#include "sdf/solid.h"

namespace probegi {

float signedDistance(const SdfScene& sdf, glm::vec3 point) {
    float nearest = kernels::kSdfFar;
    for (const SdfPrimitive& primitive : sdf.primitives) {
        nearest = std::min(nearest, kernels::sdfDistance(makeSolid(primitive), point));
    }
    return nearest;
}

}  // namespace probegi
