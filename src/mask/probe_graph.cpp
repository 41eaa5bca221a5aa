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
constexpr std::array<std::array<std::size_t, 8>, 8> kPairNumber = [] {
    std::array<std::array<std::size_t, 8>, 8> number{};
    for (std::size_t p = 0; p < kPairs.size(); ++p) number[kPairs[p].low][kPairs[p].high] = p;
    return number;
}();
using PairSums = std::array<float, kPairs.size()>;

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
    m_smaller = smallerWeights(factor);
    m_cellAt.assign(cells.probes.size(), -1);
    for (std::size_t c = 0; c < cells.blocked.size(); ++c) m_cellAt[std::size_t(cells.blocked[c].slot[0])] = int(c);
    m_sums.resize(cells.blocked.size());
    parallelFor(context, m_sums.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            m_sums[c] = differences(std::span(sight.seen).subspan(c * m_smaller.size(), m_smaller.size()), m_smaller);
    });
    for (const MaskCell& cell : cells.blocked)
        for (std::size_t p = 0; p < kPairs.size(); ++p) sumPair(cells, cell, p);
    for (const Forward& of : m_forward)
        for (const float e : of) m_largest = std::max(m_largest, e);
}

void ProbeGraph::update(const MaskCells& cells, const ProbeSight& sight, std::span<const std::size_t> changed) {
    m_sums.resize(cells.blocked.size());
    for (const std::size_t c : changed) {
        m_cellAt[std::size_t(cells.blocked[c].slot[0])] = int(c);
        m_sums[c] = differences(std::span(sight.seen).subspan(c * m_smaller.size(), m_smaller.size()), m_smaller);
    }
    for (const std::size_t c : changed)
        for (std::size_t p = 0; p < kPairs.size(); ++p) sumPair(cells, cells.blocked[c], p);
}

// Over all cells that have both probes, in the order of their slots. Where the two do not lie apart along an axis,
// cells on either side of them have both.
void ProbeGraph::sumPair(const MaskCells& cells, const MaskCell& cell, std::size_t pair) {
    const std::size_t low = kPairs[pair].low, high = kPairs[pair].high, common = ~(low ^ high) & 7;
    const auto slotOf = [&](std::size_t corner) { return std::size_t(cell.slot[corner]); };
    float& sum = m_forward[slotOf(low)][std::size_t(aroundOf(kPairs[pair]) - 14)];
    sum = 0;
    for (std::size_t side = 8; side-- > 0;) {
        if ((side & ~common) != 0) continue;
        // The cell where the pair is at these corners, if there is one.
        const std::size_t lowThere = (low & ~common) | side, highThere = (high & ~common) | side;
        const int number = cellWith(cells, slotOf(low), lowThere);
        if (number >= 0) sum += m_sums[std::size_t(number)][kPairNumber[lowThere][highThere]];
    }
}

int ProbeGraph::cellWith(const MaskCells& cells, std::size_t slot, std::size_t corner) const noexcept {
    const glm::ivec3 counts = latticeOf(slot).counts;
    const int row = counts.x, layer = row * counts.y;
    const std::size_t toCorner =
        (corner & 1) + (corner >> 1 & 1) * std::size_t(row) + (corner >> 2) * std::size_t(layer);
    if (slot < toCorner) return -1;
    // Numbers beyond the lattice's sides are those of other probes, which are no lowest ones or of other cells.
    const int number = m_cellAt[slot - toCorner];
    return number >= 0 && std::size_t(cells.blocked[std::size_t(number)].slot[corner]) == slot ? number : -1;
}

bool ProbeGraph::sameAround(const ProbeGraph& other, std::size_t slot) const {
    std::array<float, 26> costs{};
    std::size_t count = 0;
    other.forNeighbours(slot, [&](std::size_t, float difference) { costs[count++] = difference; });
    bool same = true;
    count = 0;
    forNeighbours(slot, [&](std::size_t, float difference) { same = same && costs[count++] == difference; });
    return same;
}

const ProbeGraph::Lattice& ProbeGraph::latticeOf(std::size_t slot) const noexcept {
    std::size_t i = 0;
    while (i + 1 < m_lattices.size() && slot >= m_lattices[i + 1].first) ++i;
    return m_lattices[i];
}

}  // namespace probegi
