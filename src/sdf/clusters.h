#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/sdf/cluster.h"

namespace probegi {

/// Solids grouped by nearness.
struct SdfClusters {
    std::vector<kernels::SdfCluster> clusters;
    std::vector<kernels::SdfSolid> solids;  ///< cluster by cluster
    std::vector<std::int32_t> numbers;      ///< of each of them, as they were given
};

/// K-means over the solids' centres (SDFDDGI, section 3.1), with planes, which have no middle, in a cluster of their
/// own. `count`: clusters besides that, at least 1; 0: the square root of the number of solids. The same solids give
/// the same clusters.
SdfClusters clusterSolids(std::span<const kernels::SdfSolid> solids, int count = 0);

/// All of them in one cluster that is never rejected.
SdfClusters oneCluster(std::span<const kernels::SdfSolid> solids);

}  // namespace probegi
