#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bvh/binary_tree.h"

namespace probegi {

/// What a ray pays, in visits of a node.
struct CollapseCosts {
    float leafItem;   ///< for an item of a leaf
    int maxLeafSize;  ///< <= kernels::kBvhLeafSize
};

/// What stands in a slot of a wide node: an inner node, or a leaf of items [first, first + count) of the wide order.
struct WideChild {
    Bounds box = kNothing;
    std::uint32_t first = 0;
    std::uint32_t count = 0;  ///< 0: an inner node, or nothing
    std::uint32_t node = 0;   ///< of an inner node; 0 (the root) otherwise
    bool empty() const { return count == 0 && node == 0; }
};

struct WideNode {
    Bounds box;
    std::array<WideChild, 8> slots{};
};

/// Parents stand before their children, children of one node side by side in the order of their slots; so do items of
/// one node's leaves in `order`.
struct WideTree {
    std::vector<WideNode> nodes;
    std::vector<std::uint32_t> order;
    int levels = 0;
};

/// Joins binary nodes to wide ones of least expected cost (Ylitie, Karras, Laine 2017, section 3.3).
WideTree collapse(const BinaryTree& tree, const CollapseCosts& costs);

/// Three levels of a balanced tree become one, so there are log8 of the items of them.
WideTree collapseByLevels(const BinaryTree& balanced, int maxLeafSize);

}  // namespace probegi
