#include "mask/mask_texels.h"

#include <algorithm>
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

/// A texel and the next one along an axis.
struct TexelPair {
    std::size_t first, next;
    int axis;
    glm::vec3 from, to;  // their places
};

/// Calls body(pair) for all pairs of a cell's texels.
template <class Body>
void forPairs(const MaskCell& cell, int factor, const Body& body) {
    for (int z = 0; z < factor; ++z)
        for (int y = 0; y < factor; ++y)
            for (int x = 0; x < factor; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 next(x, y, z);
                    if (++next[axis] == factor) continue;
                    body(TexelPair{std::size_t(x + factor * (y + factor * z)),
                                   std::size_t(next.x + factor * (next.y + factor * next.z)), axis, cell.texel(x, y, z),
                                   cell.texel(next.x, next.y, next.z)});
                }
}

/// A blind texel sees by what is beside it in the open: behind a thing that hides all probes is still the same room.
/// Rays reach a little beyond it: one that lies on a wall stays blind. Returns the number of rays.
Result<std::uint64_t> flood(const Tracer& tracer, const MaskCell& cell, int factor, std::span<std::uint8_t> masks) {
    std::uint64_t count = 0;
    std::vector<bool> asked(3 * masks.size());
    std::vector<TexelPair> pairs;
    std::vector<Ray> rays;
    std::vector<std::uint8_t> blocked;
    do {
        pairs.clear();
        rays.clear();
        forPairs(cell, factor, [&](const TexelPair& pair) {
            const std::size_t number = 3 * pair.first + std::size_t(pair.axis);
            if ((masks[pair.first] == 0) == (masks[pair.next] == 0) || asked[number]) return;
            asked[number] = true;
            pairs.push_back(pair);
            const bool ahead = masks[pair.next] == 0;
            rays.push_back(
                sightRay(ahead ? pair.from : pair.to, ahead ? pair.to : pair.from, kReachBeyond * cell.texelSize));
        });
        count += rays.size();
        blocked.resize(rays.size());
        if (auto traced = tracer.occluded(rays, blocked); !traced) return traced.error();
        const std::vector<std::uint8_t> before(masks.begin(), masks.end());
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (blocked[i]) continue;
            const std::size_t blind = before[pairs[i].first] == 0 ? pairs[i].first : pairs[i].next;
            masks[blind] |= std::uint8_t(before[pairs[i].first] | before[pairs[i].next]);
        }
    } while (!pairs.empty());
    return count;
}

/// The middle of what is on the way, 0..1; `there` and `back`: what rays from both ends meet.
float middleOf(const Hit& there, const Hit& back, float length) {
    const float from = there.valid() ? there.distance : length - back.distance;
    const float to = back.valid() ? length - back.distance : there.distance;
    return std::clamp(0.5f * (from + to) / length, 0.0f, 1.0f);
}

/// Notes the walls between texels that see different clusters. Returns the number of rays, there and back.
Result<std::uint64_t> findWalls(const Tracer& tracer, const MaskCell& cell, std::span<const std::uint8_t> masks,
                                int factor, std::span<std::uint32_t> texels) {
    std::vector<TexelPair> pairs;
    std::vector<Ray> rays;
    forPairs(cell, factor, [&](const TexelPair& pair) {
        if (masks[pair.first] == masks[pair.next]) return;
        pairs.push_back(pair);
        rays.push_back(sightRay(pair.from, pair.to, 0.0f));
        rays.push_back(sightRay(pair.to, pair.from, 0.0f));
    });
    std::vector<Hit> hits(rays.size());
    if (auto traced = tracer.closestHits(rays, hits); !traced) return traced.error();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Hit &there = hits[2 * i], &back = hits[2 * i + 1];
        if (!there.valid() && !back.valid()) continue;
        const float place = middleOf(there, back, rays[2 * i].far);
        texels[pairs[i].first] |= (1u + std::uint32_t(place * 14.0f + 0.5f)) << (4 + 4 * pairs[i].axis);
    }
    return std::uint64_t(rays.size());
}

}  // namespace

Result<MaskSums> solveCell(const Tracer& tracer, const MaskCell& cell, std::span<const std::uint8_t> seen,
                           const Clusters& clusters, const MaskSolve& how,
                           const std::vector<std::array<float, 8>>& weights, std::span<std::uint32_t> texels) {
    const CellSolver solver(cell, clusters, how.strict);
    std::vector<std::uint8_t> masks(weights.size());
    MaskSums sums;
    for (std::size_t t = 0; t < weights.size(); ++t) {
        masks[t] = solver.solve(seen[t], weights[t]);
        sums.residual += solver.residual(seen[t], masks[t], weights[t]);
        sums.leaking += solver.residual(seen[t], 255, weights[t]);
    }
    const auto flooded = flood(tracer, cell, how.factor, masks);
    if (!flooded) return flooded.error();
    for (std::size_t t = 0; t < masks.size(); ++t) {
        texels[t] = texelOf(masks[t]);
        sums.seenClusters += std::uint64_t(std::popcount(masks[t] & solver.present()));
        sums.blind += masks[t] == 0;
    }
    const auto walls = findWalls(tracer, cell, masks, how.factor, texels);
    if (!walls) return walls.error();
    sums.rays = *flooded + *walls;
    return sums;
}

Result<MaskTexels> solveMasks(const Context& context, const Tracer& tracer, const MaskCells& cells,
                              const ProbeSight& sight, const Clusters& clusters, const MaskSolve& how) {
    const std::vector<std::array<float, 8>> weights = texelWeights(how.factor);
    const std::size_t perCell = weights.size();
    MaskTexels result;
    result.texels.resize(sight.seen.size());
    std::vector<MaskSums> sums(cells.blocked.size());
    Progress progress(context, "solving masks", double(cells.blocked.size()));
    auto solved = tryParallelFor(context, cells.blocked.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const auto cell = solveCell(tracer, cells.blocked[c], std::span(sight.seen).subspan(c * perCell, perCell),
                                        clusters, how, weights, std::span(result.texels).subspan(c * perCell, perCell));
            if (!cell) return Result<void>(cell.error());
            sums[c] = *cell;
        }
        if (!progress.advance(double(end - begin)))
            return Result<void>(fail(ErrorCode::cancelled, "cancelled while baking masks"));
        return Result<void>();
    });
    if (!solved) return solved.error();
    for (const MaskSums& cell : sums) {  // in the order of the cells
        result.sums.residual += cell.residual;
        result.sums.leaking += cell.leaking;
        result.sums.rays += cell.rays;
        result.sums.seenClusters += cell.seenClusters;
        result.sums.blind += cell.blind;
    }
    return result;
}

}  // namespace probegi
