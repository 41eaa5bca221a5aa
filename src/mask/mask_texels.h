#pragma once

#include "mask/colouring.h"

namespace probegi {

/// Texel of the kernels from a bit for each of eight clusters.
constexpr std::uint32_t texelOf(unsigned mask) {
    return (mask & 15u) | (mask >> 4 & 15u) << 16;
}
constexpr std::uint32_t kOpenTexel = texelOf(255);

/// What the masks of a cell, or of many, add up to.
struct MaskSums {
    double residual = 0;  ///< eq. 5
    double leaking = 0;   ///< the same for masks that see everything
    std::uint64_t rays = 0;
    std::uint64_t seenClusters = 0;  ///< over all texels, of those in their cells
    std::uint64_t blind = 0;         ///< texels
};

/// Masks at the texels of the blocked cells, and the walls between them: [cell][texel], words of
/// kernels/guards/masks.h. Bits of clusters that no probe of the cell has are 1 where a texel sees any.
struct MaskTexels {
    std::vector<std::uint32_t> texels;
    MaskSums sums;
};

/// How masks are solved.
struct MaskSolve {
    int factor = 8;
    bool strict = false;
};

/// One cell's part of solveMasks(). `seen`: its part of ProbeSight::seen. `weights`: texelWeights().
Result<MaskSums> solveCell(const Tracer& tracer, const MaskCell& cell, std::span<const std::uint8_t> seen,
                           const Clusters& clusters, const MaskSolve& how,
                           const std::vector<std::array<float, 8>>& weights, std::span<std::uint32_t> texels);

/// Solves eq. 5 for the masks: for each texel and cluster the weighted median of what it sees of the cluster's probes;
/// with `strict` whether it sees all. Then finds the walls between texels side by side that see different clusters:
/// look-ups must not blend these. Errors: cancelled, and those of the tracer.
Result<MaskTexels> solveMasks(const Context& context, const Tracer& tracer, const MaskCells& cells,
                              const ProbeSight& sight, const Clusters& clusters, const MaskSolve& how);

}  // namespace probegi
