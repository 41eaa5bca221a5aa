#pragma once

#include <span>

#include "kernels/sdf/sdf_solid.h"
#include "probegi/sdf.h"

namespace probegi {

/// The faces of boxes that emit, as triangles for emitter sampling. Their materials are numbers of primitives. Lamps of
/// other shapes are not in the set: update rays find those alone.
EmitterSet emittersOf(std::span<const SdfPrimitive> primitives, std::span<const kernels::SdfSolid> solids);

/// Surface::material of a primitive's hits: its number where it is in the set, else -1.
inline std::int32_t emitterMaterial(const EmitterSet& set, std::size_t primitive) noexcept {
    const auto material = std::int32_t(primitive);
    return set.density(material) > 0.0f ? material : -1;
}

}  // namespace probegi
