#pragma once

#include "mask/colouring.h"

namespace probegi {

/// Masks at the texels of the blocked cells: [cell][texel], bit k: the texel sees cluster k; 0: it is blind. Bits of
/// clusters that no probe of the cell has are 1 where a texel sees any.
struct MaskTexels {
    std::vector<std::uint8_t> masks;
    std::uint64_t rays = 0;
    double residual = 0;             ///< eq. 5
    double leaking = 0;              ///< the same for masks that see everything
    std::uint64_t seenClusters = 0;  ///< over all texels, of those in their cells
    std::uint64_t blind = 0;         ///< texels
};

/// Solves eq. 5 for the masks: for each texel and cluster the weighted median of what it sees of the cluster's probes;
/// with `strict` whether it sees all. Then texels that lie on two sides of something thin keep only what both see,
/// since look-ups blend them. Errors: cancelled, and those of the tracer.
Result<MaskTexels> solveMasks(const Context& context, const Tracer& tracer, const MaskCells& cells,
                              const ProbeSight& sight, const Clusters& clusters, int factor, bool strict);

}  // namespace probegi
