#include "mask/colouring.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/progress.h"
#include "kernels/random.h"

namespace probegi {

namespace {

/// Largest rise that is tried at a temperature, in temperatures: above, exp() is as good as 0.
constexpr float kHopeless = 16.0f;
/// The last temperature, in lambdas.
constexpr float kColdest = 0.25f;

float coldestOf(float sparsity) {
    return std::max(kColdest * sparsity, 1e-5f);
}

/// What one colour costs a probe beside another of it: E, or what eq. 8 would take for two colours.
float costOf(float difference, float sparsity) {
    return difference > 0.0f ? difference : -sparsity;
}

/// A colouring and, for each of some probes and each colour, what that colour would cost it: kept up as these change.
class Colouring {
public:
    Colouring(const ProbeGraph& graph, Clusters clusters, std::span<const std::size_t> slots, int colours,
              float sparsity)
        : m_graph(graph),
          m_colours(std::size_t(colours)),
          m_sparsity(sparsity),
          m_clusters(std::move(clusters)),
          m_cost(graph.probes() * m_colours) {
        for (const std::size_t slot : slots)
            graph.forNeighbours(slot, [&](std::size_t other, float difference) {
                m_cost[slot * m_colours + m_clusters[other]] += costOf(difference, m_sparsity);
            });
    }

    std::size_t colours() const { return m_colours; }
    std::size_t colourOf(std::size_t slot) const { return m_clusters[slot]; }
    float change(std::size_t slot, std::size_t colour) const {
        return m_cost[slot * m_colours + colour] - m_cost[slot * m_colours + m_clusters[slot]];
    }
    void take(std::size_t slot, std::size_t colour) {
        m_gain -= double(change(slot, colour));
        const std::size_t before = m_clusters[slot];
        m_graph.forNeighbours(slot, [&](std::size_t other, float difference) {
            const float cost = costOf(difference, m_sparsity);
            m_cost[other * m_colours + before] -= cost;
            m_cost[other * m_colours + colour] += cost;
        });
        m_clusters[slot] = std::uint8_t(colour);
    }
    const Clusters& clusters() const { return m_clusters; }
    double gain() const { return m_gain; }  ///< by how much the loss has fallen

private:
    const ProbeGraph& m_graph;
    std::size_t m_colours;
    float m_sparsity;
    Clusters m_clusters;
    std::vector<float> m_cost;
    double m_gain = 0;
};

/// Every probe once: takes another colour, at random, by the rule of Metropolis.
void sweep(Colouring& colouring, std::span<const std::size_t> slots, float temperature, kernels::uint& random) {
    const std::size_t others = colouring.colours() - 1;
    for (const std::size_t slot : slots) {
        const std::size_t step = 1 + std::min(others - 1, std::size_t(kernels::nextRandom(random) * float(others)));
        const std::size_t colour = (colouring.colourOf(slot) + step) % colouring.colours();
        const float change = colouring.change(slot, colour);
        if (change > kHopeless * temperature) continue;
        if (change <= 0.0f || kernels::nextRandom(random) < std::exp(-change / temperature))
            colouring.take(slot, colour);
    }
}

float temperatureAt(int i, int sweeps, float hottest, float coldest) {
    return hottest * std::pow(coldest / hottest, float(i) / float(std::max(1, sweeps - 1)));
}

/// Until no probe alone can do better. Rounding of the sums could go in circles: a gain must be worth it.
void goDownhill(Colouring& colouring, std::span<const std::size_t> slots, float least) {
    constexpr int kMostRounds = 1000;
    bool changed = true;
    for (int round = 0; changed && round < kMostRounds; ++round) {
        changed = false;
        for (const std::size_t slot : slots) {
            std::size_t best = colouring.colourOf(slot);
            for (std::size_t colour = 0; colour < colouring.colours(); ++colour)
                if (colouring.change(slot, colour) < colouring.change(slot, best) - least) best = colour;
            if (best == colouring.colourOf(slot)) continue;
            colouring.take(slot, best);
            changed = true;
        }
    }
}

struct Box {
    glm::ivec3 lower, upper;  // upper: not in it
    int clusters;
};

/// Cuts a box across its longest axis until each has one cluster; numbers them as they come.
void divide(const ProbeGraph::Lattice& lattice, Box box, int& next, Clusters& clusters) {
    const glm::ivec3 size = box.upper - box.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (box.clusters > 1 && size[axis] > 1) {
        const int left = box.clusters / 2;
        const int cut = box.lower[axis] + std::max(1, size[axis] * left / box.clusters);
        Box low{box.lower, box.upper, left}, high{box.lower, box.upper, box.clusters - left};
        low.upper[axis] = high.lower[axis] = cut;
        divide(lattice, low, next, clusters);
        divide(lattice, high, next, clusters);
        return;
    }
    for (int z = box.lower.z; z < box.upper.z; ++z)
        for (int y = box.lower.y; y < box.upper.y; ++y)
            for (int x = box.lower.x; x < box.upper.x; ++x)
                clusters[lattice.first + std::size_t(x + lattice.counts.x * (y + lattice.counts.y * z))] =
                    std::uint8_t(next);
    next += box.clusters;
}

}  // namespace

Clusters parityClusters(const ProbeGraph& graph) {
    Clusters clusters(graph.probes());
    for (std::size_t slot = 0; slot < clusters.size(); ++slot) {
        const ProbeGraph::Lattice& of = graph.latticeOf(slot);
        const int number = int(slot - of.first), row = of.counts.x;
        clusters[slot] = std::uint8_t((number % row & 1) | (number / row % of.counts.y & 1) << 1 |
                                      (number / (row * of.counts.y) & 1) << 2);
    }
    return clusters;
}

Clusters convexDivision(const ProbeGraph& graph, int clusters) {
    Clusters result(graph.probes());
    for (const ProbeGraph::Lattice& lattice : graph.lattices()) {
        int next = 0;
        divide(lattice, {glm::ivec3(0), lattice.counts, clusters}, next, result);
    }
    return result;
}

double colouringLoss(const ProbeGraph& graph, const Clusters& clusters, float sparsity) {
    double twice = 0;
    for (std::size_t slot = 0; slot < graph.probes(); ++slot)
        graph.forNeighbours(slot, [&](std::size_t other, float difference) {
            if (clusters[slot] == clusters[other])
                twice += double(difference);
            else if (!(difference > 0.0f))
                twice += double(sparsity);
        });
    return twice / 2;
}

Result<Clusters> annealColours(const Context& context, const ProbeGraph& graph, Clusters start,
                               const ColouringDesc& desc) {
    if (desc.clusters < 2) return start;
    Progress progress(context, "colouring probes", desc.sweeps);
    std::vector<std::size_t> all(graph.probes());
    std::iota(all.begin(), all.end(), std::size_t(0));
    Colouring colouring(graph, start, all, desc.clusters, desc.sparsity);
    const float coldest = coldestOf(desc.sparsity), hottest = std::max(graph.largest(), coldest);
    kernels::uint random = kernels::hashCombine(kernels::uint(desc.seed), kernels::uint(desc.seed >> 32));
    for (int i = 0; i < desc.sweeps; ++i) {
        sweep(colouring, all, temperatureAt(i, desc.sweeps, hottest, coldest), random);
        if (!progress.advance()) return fail(ErrorCode::cancelled, "cancelled while baking masks");
    }
    goDownhill(colouring, all, 0.5f * coldest);
    const Clusters& found = colouring.clusters();
    return colouringLoss(graph, found, desc.sparsity) < colouringLoss(graph, start, desc.sparsity) ? found : start;
}

void recolour(const ProbeGraph& graph, std::span<const std::size_t> slots, const ColouringDesc& desc,
              Clusters& clusters) {
    if (desc.clusters < 2 || slots.empty()) return;
    const float coldest = coldestOf(desc.sparsity), hottest = std::max(graph.largest(), coldest);
    Colouring near(graph, clusters, slots, desc.clusters, desc.sparsity), annealed = near;
    goDownhill(near, slots, 0.5f * coldest);
    kernels::uint random = kernels::hashCombine(kernels::uint(desc.seed), kernels::uint(desc.seed >> 32));
    for (int i = 0; i < desc.sweeps; ++i)
        sweep(annealed, slots, temperatureAt(i, desc.sweeps, hottest, coldest), random);
    goDownhill(annealed, slots, 0.5f * coldest);
    clusters = (annealed.gain() > near.gain() ? annealed : near).clusters();
}

}  // namespace probegi
