#include "bvh/binary_tree.h"

namespace probegi {

Result<BinaryTree> buildBinaryTree(const Context&, std::span<const BuildItem> items) {
    return buildBalancedTree(items);
}

bool treesFollowAHeuristic() noexcept {
    return false;
}

}  // namespace probegi
