#pragma once

#include "bvh/binary_tree.h"

namespace probegi {

// Helpers for building a BinaryTree, children first.

inline BinaryTree emptyTree(std::size_t items) {
    BinaryTree tree;
    tree.nodes.reserve(2 * items);
    tree.order.reserve(items);
    return tree;
}

/// Joins the last two subtrees, of which `left` is the first.
inline std::uint32_t join(BinaryTree& tree, std::uint32_t left, std::uint32_t right) {
    const BinaryNode &a = tree.nodes[left], &b = tree.nodes[right];
    const BinaryNode parent{united(a.box, b.box), a.first, a.count + b.count, left, right};
    tree.nodes.push_back(parent);
    return std::uint32_t(tree.nodes.size()) - 1;
}

inline std::uint32_t appendLeaf(BinaryTree& tree, const BuildItem& item) {
    tree.nodes.push_back({item.box, std::uint32_t(tree.order.size()), 1});
    tree.order.push_back(item.id);
    return std::uint32_t(tree.nodes.size()) - 1;
}

}  // namespace probegi
