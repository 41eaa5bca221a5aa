#pragma once

#include "mask/probe_graph.h"

namespace probegi {

/// The cluster of each probe, by slot: g of section 3.2.
using Clusters = std::vector<std::uint8_t>;

/// How eqs. 7 and 8 are minimised.
struct ColouringDesc {
    int clusters = 4;
    int sweeps = 800;
    float sparsity = 0.001f;  ///< lambda
    std::uint64_t seed = 1;
};

/// Eq. 4: no two probes of a cell have the same of eight clusters.
Clusters parityClusters(const ProbeGraph& graph);

/// The start: each volume cut into boxes, always the longest across.
Clusters convexDivision(const ProbeGraph& graph, int clusters);

/// Eqs. 7 and 8: E over the neighbours of one colour, and lambda for each pair of neighbours with E = 0 and two.
double colouringLoss(const ProbeGraph& graph, const Clusters& clusters, float sparsity);

/// Simulated annealing from `start`, at last downhill; never worse than the start. Errors: cancelled.
Result<Clusters> annealColours(const Context& context, const ProbeGraph& graph, Clusters start,
                               const ColouringDesc& desc);

/// Colours some probes again, the others as they are: by annealing these alone, and by going downhill from what they
/// have; the better one. `slots` in rising order.
void recolour(const ProbeGraph& graph, std::span<const std::size_t> slots, const ColouringDesc& desc,
              Clusters& clusters);

}  // namespace probegi
