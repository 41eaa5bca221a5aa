#pragma once

#include <vector>

#include "kernels/sdf/cluster.h"

namespace probegi::kernels {

/// What the kernels of the folder sdf find, of all tests: C++ has one sdfSolid() for all files of a program.
inline std::vector<SdfSolid> theSolids;
inline std::vector<SdfCluster> theClusters;
inline int theClusterReads = 0;  ///< since a test last set it to 0

inline SdfSolid sdfSolid(int number) {
    return theSolids[std::size_t(number)];
}
inline SdfCluster sdfCluster(int number) {
    ++theClusterReads;
    return theClusters[std::size_t(number)];
}

}  // namespace probegi::kernels
