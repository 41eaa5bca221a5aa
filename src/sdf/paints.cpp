#include "sdf/paints.h"

namespace probegi {

static_assert(kernels::kSdfFaceSide == kSdfFaceSide);

SdfPaints paintsOf(std::span<const SdfPrimitive> primitives) {
    SdfPaints out;
    for (const SdfPrimitive& p : primitives) {
        out.paints.push_back({p.albedo, p.emission, p.faces.empty() ? -1 : int(out.texels.size())});
        for (const glm::vec3& colour : p.faces) out.texels.push_back(kernels::sdfPackColour(colour));
    }
    return out;
}

}  // namespace probegi
