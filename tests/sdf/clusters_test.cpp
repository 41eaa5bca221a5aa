#include "sdf/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "sdf/placed_primitives.h"
#include "sdf/solid.h"

namespace probegi {
namespace {

kernels::SdfSolid boxAt(glm::vec3 centre) {
    SdfPrimitive box;
    box.centre = centre;
    box.halfSize = {0.2f, 0.5f, 0.1f};
    return makeSolid(box);
}

TEST(ClusterSolids, findsGroups) {
    std::vector<kernels::SdfSolid> solids;
    for (int i = 0; i < 30; ++i)
        solids.push_back(boxAt({10.0f * float(i % 3), 0.1f * float(i / 3), float(i % 2) * 0.2f}));
    const SdfClusters found = clusterSolids(solids, 3);
    ASSERT_EQ(found.clusters.size(), 3u);
    for (const kernels::SdfCluster& cluster : found.clusters) {
        ASSERT_EQ(cluster.count, 10);
        std::set<int> columns;
        for (int i = 0; i < cluster.count; ++i) columns.insert(found.numbers[std::size_t(cluster.first + i)] % 3);
        EXPECT_EQ(columns.size(), 1u);
    }
}

TEST(ClusterSolids, holdsAllSolidsInBalls) {
    std::vector<kernels::SdfSolid> solids;
    for (int i = 0; i < 50; ++i) solids.push_back(boxAt({float(i * 7 % 13), float(i * 5 % 11), float(i * 3 % 17)}));
    SdfPrimitive ground;
    ground.shape = SdfShape::plane;
    solids.push_back(makeSolid(ground));
    const SdfClusters found = clusterSolids(solids);
    EXPECT_EQ(found.clusters.size(), 8u) << "a plane, and the root of 50";
    std::set<int> numbers(found.numbers.begin(), found.numbers.end());
    EXPECT_EQ(numbers.size(), 51u);
    for (const kernels::SdfCluster& cluster : found.clusters)
        for (int i = cluster.first; i < cluster.first + cluster.count; ++i) {
            const kernels::SdfSolid& solid = found.solids[std::size_t(i)];
            EXPECT_EQ(solid.centre, solids[std::size_t(found.numbers[std::size_t(i)])].centre);
            if (solid.shape == kernels::kSdfPlane) {
                EXPECT_EQ(cluster.radius, kernels::kSdfFar);
                continue;
            }
            const Bounds bounds = boundsOf(solid);
            EXPECT_LE(glm::distance(cluster.centre, bounds.lower), cluster.radius);
            EXPECT_LE(glm::distance(cluster.centre, bounds.upper), cluster.radius);
        }
}

TEST(ClusterSolids, fewAndNone) {
    EXPECT_TRUE(clusterSolids({}).clusters.empty());
    EXPECT_TRUE(oneCluster({}).clusters.empty());
    const std::vector<kernels::SdfSolid> same(5, boxAt({1, 2, 3}));
    int all = 0;
    for (const kernels::SdfCluster& cluster : clusterSolids(same, 4).clusters) all += cluster.count;
    EXPECT_EQ(all, 5);
    EXPECT_EQ(oneCluster(same).clusters.size(), 1u);
}

}  // namespace
}  // namespace probegi
