#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/sdf/face_texels.h"
#include "probegi/sdf.h"

namespace probegi {

/// What primitives look like, as kernels take it.
struct SdfPaints {
    std::vector<kernels::SdfPaint> paints;  ///< by primitive
    std::vector<std::uint32_t> texels;      ///< of all faces
};

SdfPaints paintsOf(std::span<const SdfPrimitive> primitives);

}  // namespace probegi
