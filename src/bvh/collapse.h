#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bvh/binary_tree.h"

namespace probegi {

/// Traversal costs, in node visits.
struct CollapseCosts {
    float leafItem;   ///< per item of a leaf
    int maxLeafSize;  ///< <= kernels::kBvhLeafSize
};

/// A slot of a wide node: an inner node, or a leaf of items [first, first + count) of the wide order.
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

/// Parents precede their children; children of a node are adjacent, in slot order, as are the items of its leaves in
/// `order`.
struct WideTree {
    std::vector<WideNode> nodes;
    std::vector<std::uint32_t> order;
    int levels = 0;
};

/// Merges binary nodes into wide ones of minimum expected cost (Ylitie, Karras, Laine 2017, section 3.3).
WideTree collapse(const BinaryTree& tree, const CollapseCosts& costs);

/// Merges three levels of a balanced tree into one: log8(items) levels.
WideTree collapseByLevels(const BinaryTree& balanced, int maxLeafSize);

}  // namespace probegi
