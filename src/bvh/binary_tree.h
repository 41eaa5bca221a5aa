#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "probegi/context.h"
#include "probegi/scene.h"

namespace probegi {

/// The empty box.
inline constexpr Bounds kNothing{glm::vec3(std::numeric_limits<float>::infinity()),
                                 glm::vec3(-std::numeric_limits<float>::infinity())};

inline Bounds united(const Bounds& a, const Bounds& b) {
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

/// An item of the tree.
struct BuildItem {
    Bounds box;
    std::uint32_t id;  ///< the caller's
};

/// A node over items [first, first + count) of the tree's order. count == 1: a leaf, without children.
struct BinaryNode {
    Bounds box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t left = 0;
    std::uint32_t right = 0;
};

struct BinaryTree {
    std::vector<BinaryNode> nodes;     ///< children before parents, the root last
    std::vector<std::uint32_t> order;  ///< ids
};

/// By the surface area heuristic (Embree's builder); median splits if built without Embree. There must be at least one
/// item. Errors: outOfMemory, invalidArgument.
Result<BinaryTree> buildBinaryTree(const Context& context, std::span<const BuildItem> items);
/// Whether buildBinaryTree() uses the heuristic.
bool treesFollowAHeuristic() noexcept;

/// Median splits: minimum depth, for input on which the heuristic gets too deep.
BinaryTree buildBalancedTree(std::span<const BuildItem> items);

}  // namespace probegi
