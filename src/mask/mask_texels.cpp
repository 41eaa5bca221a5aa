#include "mask/mask_texels.h"

#include <atomic>
#include <bit>

#include "core/parallel.h"
#include "core/progress.h"

namespace probegi {

namespace {

/// Added to trilinear weights, so that on a face of the cell the far probes still decide for a cluster of their own.
constexpr float kLeastWeight = 1e-3f;

/// One cell's masks, by what a texel sees and where it is.
class CellSolver {
public:
    CellSolver(const MaskCell& cell, const Clusters& clusters, bool strict) : m_strict(strict) {
        for (std::size_t i = 0; i < 8; ++i) m_members[clusters[std::size_t(cell.slot[i])]] |= 1u << i;
        for (unsigned k = 0; k < 8; ++k)
            if (m_members[k] != 0) m_present |= 1u << k;
    }

    unsigned present() const { return m_present; }

    std::uint8_t solve(unsigned seen, const std::array<float, 8>& weights) const {
        unsigned mask = ~m_present & 255u;
        for (unsigned k = 0; k < 8; ++k)
            if (m_members[k] != 0 && sees(m_members[k], seen, weights)) mask |= 1u << k;
        return std::uint8_t((mask & m_present) != 0 ? mask : 0);
    }

    /// Eq. 5 of one texel.
    double residual(unsigned seen, unsigned mask, const std::array<float, 8>& weights) const {
        double sum = 0;
        for (unsigned k = 0; k < 8; ++k)
            for (unsigned i = 0; i < 8; ++i)
                if ((m_members[k] >> i & 1u) && (seen >> i & 1u) != (mask >> k & 1u)) sum += double(weights[i]);
        return sum;
    }

private:
    bool sees(unsigned members, unsigned seen, const std::array<float, 8>& weights) const {
        if ((members & ~seen) == 0) return true;
        if (m_strict || (members & seen) == 0) return false;
        float balance = 0;
        for (unsigned i = 0; i < 8; ++i)
            if (members >> i & 1u) balance += (seen >> i & 1u ? 1.0f : -1.0f) * (weights[i] + kLeastWeight);
        return balance > 0;
    }

    bool m_strict;
    unsigned m_members[8] = {};  // by cluster: bits of the cell's probes
    unsigned m_present = 0;
};

/// Two texels side by side.
struct TexelPair {
    std::size_t first, second;
};

/// The pairs whose masks differ, both seeing something, and the rays between them.
void findPairs(const MaskCell& cell, std::span<const std::uint8_t> masks, int factor, std::vector<TexelPair>& pairs,
               std::vector<Ray>& rays) {
    const float beyond = kReachBeyond * cell.texelSize;
    for (int z = 0; z < factor; ++z)
        for (int y = 0; y < factor; ++y)
            for (int x = 0; x < factor; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 next(x, y, z);
                    if (++next[axis] == factor) continue;
                    const std::size_t a = std::size_t(x + factor * (y + factor * z));
                    const std::size_t b = std::size_t(next.x + factor * (next.y + factor * next.z));
                    if (masks[a] == masks[b] || masks[a] == 0 || masks[b] == 0) continue;
                    pairs.push_back({a, b});
                    rays.push_back(sightRay(cell.texel(x, y, z), cell.texel(next.x, next.y, next.z), beyond));
                }
}

/// Texels that do not see each other keep what both see.
Result<std::uint64_t> erode(const Tracer& tracer, const MaskCell& cell, unsigned present, int factor,
                            std::span<std::uint8_t> masks) {
    std::vector<TexelPair> pairs;
    std::vector<Ray> rays;
    findPairs(cell, masks, factor, pairs, rays);
    std::vector<std::uint8_t> blocked(rays.size());
    if (auto traced = tracer.occluded(rays, blocked); !traced) return traced.error();
    const std::vector<std::uint8_t> before(masks.begin(), masks.end());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!blocked[i]) continue;
        masks[pairs[i].first] &= before[pairs[i].second];
        masks[pairs[i].second] &= before[pairs[i].first];
    }
    for (std::uint8_t& mask : masks)
        if ((mask & present) == 0) mask = 0;
    return std::uint64_t(rays.size());
}

/// What is summed over cells, in their order.
struct CellSums {
    double residual = 0, leaking = 0;
    std::uint32_t rays = 0, seenClusters = 0, blind = 0;
};

}  // namespace

Result<MaskTexels> solveMasks(const Context& context, const Tracer& tracer, const MaskCells& cells,
                              const ProbeSight& sight, const Clusters& clusters, int factor, bool strict) {
    const std::vector<std::array<float, 8>> weights = texelWeights(factor);
    MaskTexels result;
    result.masks.resize(sight.seen.size());
    std::vector<CellSums> sums(cells.blocked.size());
    Progress progress(context, "solving masks", double(cells.blocked.size()));
    const auto solveCell = [&](std::size_t c) -> Result<void> {
        const CellSolver solver(cells.blocked[c], clusters, strict);
        const auto seen = std::span(sight.seen).subspan(c * weights.size(), weights.size());
        const auto masks = std::span(result.masks).subspan(c * weights.size(), weights.size());
        CellSums& sum = sums[c];
        for (std::size_t t = 0; t < weights.size(); ++t) {
            masks[t] = solver.solve(seen[t], weights[t]);
            sum.residual += solver.residual(seen[t], masks[t], weights[t]);
            sum.leaking += solver.residual(seen[t], 255, weights[t]);
        }
        const auto rays = erode(tracer, cells.blocked[c], solver.present(), factor, masks);
        if (!rays) return rays.error();
        sum.rays = std::uint32_t(*rays);
        for (const std::uint8_t mask : masks) {
            sum.seenClusters += std::uint32_t(std::popcount(mask & solver.present()));
            sum.blind += mask == 0;
        }
        return {};
    };
    auto solved = tryParallelFor(context, cells.blocked.size(), 4, [&](std::size_t begin, std::size_t end) {
        Result<void> done;
        for (std::size_t c = begin; done && c < end; ++c) done = solveCell(c);
        if (done && !progress.advance(double(end - begin)))
            return Result<void>(fail(ErrorCode::cancelled, "cancelled while baking masks"));
        return done;
    });
    if (!solved) return solved.error();
    for (const CellSums& sum : sums) {
        result.residual += sum.residual;
        result.leaking += sum.leaking;
        result.rays += sum.rays;
        result.seenClusters += sum.seenClusters;
        result.blind += sum.blind;
    }
    return result;
}

}  // namespace probegi
