#include "field/ray_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "kernels/trace/ray_set.h"

namespace probegi {
namespace {

GridDesc gridOf(glm::ivec3 counts) {
    GridDesc grid;
    grid.counts = counts;
    return grid;
}

TEST(RayOrder, blocksHaveEveryProbeOnce) {
    for (const glm::ivec3 counts : {glm::ivec3(2, 2, 2), glm::ivec3(3, 5, 7), glm::ivec3(8, 4, 9)}) {
        const GridDesc grid = gridOf(counts);
        const ProbeBlocks blocks(grid);
        std::vector<int> seen(std::size_t(probeCount(grid)), 0);
        std::vector<std::uint32_t> probes;
        for (std::size_t block = 0; block < blocks.count(); ++block) {
            blocks.probesOf(block, probes);
            EXPECT_GE(probes.size(), 1u);
            EXPECT_LE(probes.size(), 16u);
            for (const std::uint32_t probe : probes) ++seen.at(probe);
        }
        for (const int times : seen) EXPECT_EQ(times, 1);
    }
}

TEST(RayOrder, probesOfABlockAreNeighbours) {
    const GridDesc grid = gridOf({9, 6, 8});
    const ProbeBlocks blocks(grid);
    std::vector<std::uint32_t> probes;
    for (std::size_t block = 0; block < blocks.count(); ++block) {
        blocks.probesOf(block, probes);
        for (const std::uint32_t probe : probes) {
            const glm::vec3 way = probePosition(grid, int(probe)) - probePosition(grid, int(probes.front()));
            EXPECT_LE(std::max({way.x, way.y, way.z}), 3.0f);
            EXPECT_GE(std::min({way.x, way.y, way.z}), 0.0f);
        }
    }
}

TEST(RayOrder, everyDirectionOnceAndNextToItsLike) {
    constexpr int kRays = 200;
    std::vector<glm::vec3> directions;
    for (int i = 0; i < kRays; ++i) directions.push_back(kernels::sphericalFibonacci(i, kRays));
    const std::vector<OrderedDirection> ordered = alongCurve(directions);
    ASSERT_EQ(ordered.size(), directions.size());
    std::vector<int> seen(directions.size(), 0);
    float cosines = 0;
    for (std::size_t i = 0; i < ordered.size(); ++i) {
        ++seen.at(ordered[i].index);
        EXPECT_EQ(ordered[i].direction, directions[ordered[i].index]);
        if (i > 0) cosines += glm::dot(ordered[i].direction, ordered[i - 1].direction);
    }
    for (const int times : seen) EXPECT_EQ(times, 1);
    // 0.87 was measured; in the order of the set it is -0.16.
    EXPECT_GT(cosines / (kRays - 1), 0.85f);
}

TEST(RayOrder, noDirections) {
    EXPECT_TRUE(alongCurve({}).empty());
}

}  // namespace
}  // namespace probegi
