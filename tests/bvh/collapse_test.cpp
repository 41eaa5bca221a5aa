// Wide nodes from binary ones: slots of children and sizes of leaves.
#include "bvh/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace probegi {
namespace {

BuildItem unitBox(glm::vec3 corner, std::uint32_t id) {
    return {{corner, corner + 1.0f}, id};
}

// Eight boxes in the corners of a cube: bit a of a slot's number says that its child lies towards +a (section 3.2),
// whatever the order of the boxes.
TEST(Collapse, childrenStandWhereTheirDirectionSays) {
    std::vector<BuildItem> items;
    for (std::uint32_t s = 0; s < 8; ++s) items.push_back(unitBox(10.0f * glm::vec3(s & 1, s >> 1 & 1, s >> 2), s));
    for (int order = 0; order < 20; ++order) {
        std::next_permutation(items.begin(), items.end(),
                              [](const BuildItem& a, const BuildItem& b) { return a.id * 5 % 8 < b.id * 5 % 8; });
        std::rotate(items.begin(), items.begin() + order % 8, items.end());
        for (const WideTree& tree :
             {collapse(buildBalancedTree(items), {0.3f, 1}), collapseByLevels(buildBalancedTree(items), 1)}) {
            ASSERT_EQ(tree.nodes.size(), 1u);
            EXPECT_EQ(tree.levels, 1);
            for (std::uint32_t s = 0; s < 8; ++s) {
                const WideChild& child = tree.nodes[0].slots[s];
                ASSERT_EQ(child.count, 1u) << s;
                EXPECT_EQ(tree.order[child.first], s);
            }
        }
    }
}

// Two of three boxes are close together: one leaf for all if items are cheap to test, a leaf each if they are not.
TEST(Collapse, leavesAreAsLargeAsTheyAreCheap) {
    std::vector<BuildItem> items;
    for (std::uint32_t i = 0; i < 12; ++i) items.push_back(unitBox(glm::vec3(3.0f * float(i), 0, 0), i));
    const auto leaves = [&](CollapseCosts costs) {
        int count = 0;
        for (const WideNode& node : collapse(buildBalancedTree(items), costs).nodes)
            for (const WideChild& child : node.slots) {
                EXPECT_LE(int(child.count), costs.maxLeafSize);
                count += child.count > 0 ? 1 : 0;
            }
        return count;
    };
    EXPECT_EQ(leaves({1.5f, 1}), 12);
    EXPECT_EQ(leaves({100.0f, 3}), 12) << "no leaf is worth its items";
    EXPECT_LE(leaves({0.01f, 3}), 8);
    EXPECT_GE(leaves({0.01f, 3}), 4);
}

}  // namespace
}  // namespace probegi
