#pragma once

#include "mask/probe_sight.h"

namespace probegi {

/// The graph of section 3.3: probes whose cells meet (26 neighbours), and what it costs to give two of them one colour.
class ProbeGraph {
public:
    /// Sums eq. 6 over all texels.
    ProbeGraph(const Context& context, const FieldDesc& field, const MaskCells& cells, const ProbeSight& sight,
               int factor);

    /// The same after some cells see otherwise, or are new at the end of `cells.blocked`.
    void update(const MaskCells& cells, const ProbeSight& sight, std::span<const std::size_t> changed);

    std::size_t probes() const noexcept { return m_forward.size(); }
    float largest() const noexcept { return m_largest; }  ///< E

    /// Calls body(neighbour, E) for each neighbour of a probe, in a fixed order.
    template <class Body>
    void forNeighbours(std::size_t slot, const Body& body) const;

    /// Slots of one volume's probes, first and count, and the probes along its axes.
    struct Lattice {
        std::size_t first;
        glm::ivec3 counts;
    };
    const std::vector<Lattice>& lattices() const noexcept { return m_lattices; }
    const Lattice& latticeOf(std::size_t slot) const noexcept;

    /// The number of the blocked cell that has a slot's probe at one of its corners; -1: there is none.
    int cellWith(const MaskCells& cells, std::size_t slot, std::size_t corner) const noexcept;

    /// Whether it costs the same in another graph of the same lattices to give a probe its neighbours' colours.
    bool sameAround(const ProbeGraph& other, std::size_t slot) const;

private:
    using Forward = std::array<float, 13>;
    using PairSums = std::array<float, 28>;  // of eq. 6, by pair of a cell's probes

    void sumPair(const MaskCells& cells, const MaskCell& cell, std::size_t pair);

    std::vector<Lattice> m_lattices;
    std::vector<PairSums> m_smaller;  // min(phi_i, phi_j), by texel
    std::vector<PairSums> m_sums;     // by cell
    std::vector<int> m_cellAt;        // by lowest slot; -1: none
    std::vector<Forward> m_forward;
    float m_largest = 0;
};

/// The neighbour's place among the 27 around a probe; those after 13, the probe itself, come later.
constexpr int aroundOf(int dx, int dy, int dz) {
    return dx + 1 + 3 * (dy + 1) + 9 * (dz + 1);
}

template <class Body>
void ProbeGraph::forNeighbours(std::size_t slot, const Body& body) const {
    const Lattice& of = latticeOf(slot);
    const int number = int(slot - of.first), row = of.counts.x, layer = row * of.counts.y;
    const glm::ivec3 at(number % row, number / row % of.counts.y, number / layer);
    for (int dz = at.z > 0 ? -1 : 0; dz <= (at.z + 1 < of.counts.z ? 1 : 0); ++dz)
        for (int dy = at.y > 0 ? -1 : 0; dy <= (at.y + 1 < of.counts.y ? 1 : 0); ++dy)
            for (int dx = at.x > 0 ? -1 : 0; dx <= (at.x + 1 < of.counts.x ? 1 : 0); ++dx) {
                const int around = aroundOf(dx, dy, dz);
                if (around == 13) continue;
                const std::size_t other = std::size_t(std::ptrdiff_t(slot) + dx + dy * row + dz * layer);
                body(other, around > 13 ? m_forward[slot][std::size_t(around - 14)]
                                        : m_forward[other][std::size_t(12 - around)]);
            }
}

}  // namespace probegi
