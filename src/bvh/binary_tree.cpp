#include "bvh/binary_tree.h"

#include <algorithm>

#include "bvh/tree_parts.h"

namespace probegi {

namespace {

std::uint32_t halve(BinaryTree& tree, std::span<BuildItem> items) {
    if (items.size() == 1) return appendLeaf(tree, items[0]);
    Bounds box = kNothing;
    for (const BuildItem& item : items) box = united(box, item.box);
    const glm::vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + std::ptrdiff_t(middle), items.end(),
                     [axis](const BuildItem& a, const BuildItem& b) {
                         return a.box.lower[axis] + a.box.upper[axis] < b.box.lower[axis] + b.box.upper[axis];
                     });
    const std::uint32_t left = halve(tree, items.first(middle));
    return join(tree, left, halve(tree, items.subspan(middle)));
}

}  // namespace

BinaryTree buildBalancedTree(std::span<const BuildItem> items) {
    std::vector<BuildItem> sorted(items.begin(), items.end());
    BinaryTree tree = emptyTree(items.size());
    halve(tree, sorted);
    return tree;
}

}  // namespace probegi
