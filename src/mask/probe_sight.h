#pragma once

#include "mask/mask_cells.h"

namespace probegi {

/// Visibility theta of eq. 2 at the texels of the blocked cells: [cell][texel], bit i for the cell's i-th probe; and,
/// since rays find both, which neighbours probes see.
struct ProbeSight {
    std::vector<std::uint8_t> seen;
    std::vector<std::uint8_t> links;  ///< by slot: bit 2 axis + up for the next probe along the axis
    std::uint64_t rays = 0;
};

/// Errors: cancelled, and those of the tracer.
Result<ProbeSight> traceProbeSight(const Context& context, const Tracer& tracer, const FieldDesc& field,
                                   const MaskCells& cells, int factor);

/// The probe of the cell that a texel is as good as on; 8: none.
std::size_t ownProbe(const MaskCell& cell, glm::vec3 texel);
/// A texel on a probe sees it if it sees any other: in matter it sees none.
std::uint8_t withOwnProbe(std::uint8_t seen, std::size_t own);

/// Share of a texel's smallest side by which rays reach beyond their ends: what lies on a wall is on no side of it.
inline constexpr float kReachBeyond = 0.02f;

/// The ray from one point to another and `beyond` metres farther. No length: a ray that meets nothing.
Ray sightRay(glm::vec3 from, glm::vec3 to, float beyond);

}  // namespace probegi
