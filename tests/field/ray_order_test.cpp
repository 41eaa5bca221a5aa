#include "field/ray_order.h"
#include "field/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "field/control_impl.h"
#include "kernels/trace/ray_set.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

FieldSetup withVolumes(std::vector<glm::ivec3> counts) {
    FieldSetup setup;
    setup.volumes.clear();
    for (const glm::ivec3 c : counts) setup.volumes.push_back({.counts = c});
    return setup;
}

TEST(RayOrder, blocksHaveEveryTaskOnceInOrder) {
    for (const auto& counts : {std::vector{glm::ivec3(2, 2, 2)}, {glm::ivec3(3, 5, 7)}, {{8, 4, 9}, {3, 3, 3}}}) {
        const FieldSetup setup = withVolumes(counts);
        const FieldControl control = makeFieldControl(setup, setup);
        const TaskBlocks blocks(makeVolumes(setup), control.tasks());
        std::vector<int> seen(control.tasks().size(), 0);
        for (std::size_t block = 0; block < blocks.count(); ++block) {
            const auto tasks = blocks.tasksOf(block);
            EXPECT_GE(tasks.size(), 1u);
            EXPECT_LE(tasks.size(), 16u);
            EXPECT_TRUE(std::is_sorted(tasks.begin(), tasks.end()));
            for (const std::uint32_t task : tasks) ++seen.at(task);
        }
        for (const int times : seen) EXPECT_EQ(times, 1);
    }
}

TEST(RayOrder, tasksOfABlockAreNeighboursInOneVolume) {
    const FieldSetup setup = withVolumes({{9, 6, 8}, {5, 5, 5}});
    const FieldControl control = makeFieldControl(setup, setup);
    const TaskBlocks blocks(makeVolumes(setup), control.tasks());
    for (std::size_t block = 0; block < blocks.count(); ++block) {
        const ProbeTask& first = control.tasks()[blocks.tasksOf(block).front()];
        for (const std::uint32_t number : blocks.tasksOf(block)) {
            const ProbeTask& task = control.tasks()[number];
            EXPECT_EQ(task.volume, first.volume);
            const glm::vec3 way = task.origin - first.origin;
            EXPECT_LE(std::max({way.x, way.y, way.z}), 3.0f);
            EXPECT_GE(std::min({way.x, way.y, way.z}), 0.0f);
        }
    }
}

TEST(RayOrder, aListOfSomeProbesHasTheseOnly) {
    const FieldSetup setup = withVolumes({{9, 6, 8}});
    FieldControl control = makeFieldControl(setup, setup);
    const std::vector<std::uint32_t> slots{400, 7, 8, 0};
    ASSERT_TRUE(control.setTasks(slots));
    const TaskBlocks blocks(makeVolumes(setup), control.tasks());
    std::vector<std::uint32_t> found;
    for (std::size_t block = 0; block < blocks.count(); ++block)
        for (const std::uint32_t task : blocks.tasksOf(block)) found.push_back(task);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1, 2, 3}));
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
    // Measured 0.87; in the set's own order it is -0.16.
    EXPECT_GT(cosines / (kRays - 1), 0.85f);
}

TEST(RayOrder, noDirections) {
    EXPECT_TRUE(alongCurve({}).empty());
}

}  // namespace
}  // namespace probegi
