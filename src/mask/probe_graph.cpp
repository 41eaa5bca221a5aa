#include "mask/probe_graph.h"

#include <algorithm>

#include "core/parallel.h"

namespace probegi {

namespace {

/// Pairs of a cell's probes, the lower number first.
struct Pair {
    std::size_t low, high;
};
constexpr std::array<Pair, 28> kPairs = [] {
    std::array<Pair, 28> pairs{};
    std::size_t count = 0;
    for (std::size_t low = 0; low < 8; ++low)
        for (std::size_t high = low + 1; high < 8; ++high) pairs[count++] = {low, high};
    return pairs;
}();
using PairSums = std::array<float, 28>;

/// Where the higher number's probe lies as seen from the lower's.
constexpr int aroundOf(Pair pair) {
    const auto step = [&](unsigned bit) { return int(pair.high >> bit & 1) - int(pair.low >> bit & 1); };
    return probegi::aroundOf(step(0), step(1), step(2));
}

/// min(phi_i, phi_j) of eq. 6, by texel and pair.
std::vector<PairSums> smallerWeights(int factor) {
    std::vector<PairSums> smaller;
    for (const std::array<float, 8>& w : texelWeights(factor)) {
        PairSums& of = smaller.emplace_back();
        for (std::size_t p = 0; p < kPairs.size(); ++p) of[p] = std::min(w[kPairs[p].low], w[kPairs[p].high]);
    }
    return smaller;
}

PairSums differences(std::span<const std::uint8_t> seen, std::span<const PairSums> smaller) {
    PairSums sums{};
    for (std::size_t t = 0; t < seen.size(); ++t) {
        const unsigned bits = seen[t];
        if (bits == 0 || bits == 255) continue;
        for (std::size_t p = 0; p < kPairs.size(); ++p)
            if ((bits >> kPairs[p].low ^ bits >> kPairs[p].high) & 1u) sums[p] += smaller[t][p];
    }
    return sums;
}

}  // namespace

ProbeGraph::ProbeGraph(const Context& context, const FieldDesc& field, const MaskCells& cells, const ProbeSight& sight,
                       int factor)
    : m_forward(cells.probes.size()) {
    std::size_t first = 0;
    for (const VolumeDesc& volume : field.volumes) {
        m_lattices.push_back({first, volume.counts});
        first += std::size_t(probeCount(volume));
    }
    const std::vector<PairSums> smaller = smallerWeights(factor);
    std::vector<PairSums> sums(cells.blocked.size());
    parallelFor(context, sums.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            sums[c] = differences(std::span(sight.seen).subspan(c * smaller.size(), smaller.size()), smaller);
    });
    // An edge's cells add up in their order.
    for (std::size_t c = 0; c < sums.size(); ++c)
        for (std::size_t p = 0; p < kPairs.size(); ++p) {
            float& sum =
                m_forward[std::size_t(cells.blocked[c].slot[kPairs[p].low])][std::size_t(aroundOf(kPairs[p]) - 14)];
            sum += sums[c][p];
            m_largest = std::max(m_largest, sum);
        }
}

const ProbeGraph::Lattice& ProbeGraph::latticeOf(std::size_t slot) const noexcept {
    std::size_t i = 0;
    while (i + 1 < m_lattices.size() && slot >= m_lattices[i + 1].first) ++i;
    return m_lattices[i];
}

}  // namespace probegi
