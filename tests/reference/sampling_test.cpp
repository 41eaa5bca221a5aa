#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "reference/alias_table.h"
#include "reference/random_stream.h"
#include "reference/running_stats.h"

namespace probegi {
namespace {

TEST(AliasTable, choosesByWeight) {
    const std::array<double, 6> weights = {0, 1, 5, 0.5, 0, 3.5};
    const AliasTable table(weights);
    ASSERT_FALSE(table.empty());
    EXPECT_DOUBLE_EQ(table.totalWeight(), 10);
    Random random(9, 10);
    std::array<int, 6> counts{};
    for (int i = 0; i < 40000; ++i) ++counts[table.sample(random.nextDouble())];
    for (std::size_t i = 0; i < weights.size(); ++i)
        EXPECT_NEAR(counts[i], 4000 * weights[i], 4 * std::sqrt(4000 * weights[i]) + 0.5) << i;
}

TEST(AliasTable, withoutWeightIsEmpty) {
    EXPECT_TRUE(AliasTable().empty());
    EXPECT_TRUE(AliasTable(std::array<double, 3>{}).empty());
}

TEST(RunningStats, mergingEqualsAddingOneByOne) {
    Random random(11, 12);
    RunningStats whole, left, right;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 value(random.nextDouble(), 1e6 + random.nextDouble(), -random.nextDouble());
        whole.add(value);
        (i < 300 ? left : right).add(value);
    }
    left.merge(right);
    EXPECT_EQ(left.count, whole.count);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(left.mean[c], whole.mean[c], 1e-8);
        EXPECT_NEAR(left.standardError()[c], whole.standardError()[c], 1e-8);
        EXPECT_NEAR(whole.standardError()[c], std::sqrt(1.0 / 12 / 1000), 5e-4);
    }
}

}  // namespace
}  // namespace probegi
