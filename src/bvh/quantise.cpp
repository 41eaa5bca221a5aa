#include "bvh/quantise.h"

#include <algorithm>
#include <cmath>

namespace probegi {

namespace {

using kernels::BvhNode;

constexpr int kExponentBias = 127;

void setByte(glm::uvec2& words, int slot, std::uint32_t value) {
    const int shift = 8 * (slot & 3);
    std::uint32_t& word = words[slot >> 2];
    word = (word & ~(255u << shift)) | (value << shift);
}

std::uint32_t metaOf(const BvhNode& node, int slot) {
    return (node.meta[slot >> 2] >> (8 * (slot & 3))) & 255u;
}

/// Smallest e such that 255 steps of 2^e cover the extent, within the range of normal floats.
int stepExponent(double extent) {
    int e = -kExponentBias + 1;
    if (extent > 0.0) e = std::max(e, std::ilogb(extent / 255.0));
    while (std::ldexp(255.0, e) < extent) ++e;
    return e;
}

/// One axis of a node: rounded outwards, so that a quantised box contains the exact one.
void fitAxis(BvhNode& node, int axis, const Bounds& box, const std::array<Bounds, 8>& children) {
    const std::array<glm::uvec2*, 3> lowers{&node.lowerX, &node.lowerY, &node.lowerZ};
    const std::array<glm::uvec2*, 3> uppers{&node.upperX, &node.upperY, &node.upperZ};
    const double origin = box.lower[axis];
    const int e = stepExponent(double(box.upper[axis]) - origin);
    node.origin[axis] = box.lower[axis];
    node.exponents |= std::uint32_t(e + kExponentBias) << (8 * axis);
    for (int slot = 0; slot < 8; ++slot) {
        const Bounds& child = children[std::size_t(slot)];
        // Inverted if empty.
        std::uint32_t lower = 255, upper = 0;
        if (child.lower[axis] <= child.upper[axis]) {
            lower = std::uint32_t(std::floor(std::ldexp(double(child.lower[axis]) - origin, -e)));
            upper = std::uint32_t(std::ceil(std::ldexp(double(child.upper[axis]) - origin, -e)));
        }
        setByte(*lowers[std::size_t(axis)], slot, lower);
        setByte(*uppers[std::size_t(axis)], slot, upper);
    }
}

void fitNode(BvhNode& node, const Bounds& box, const std::array<Bounds, 8>& children) {
    node.exponents &= 0xff000000u;
    const Bounds fitted = box.lower.x <= box.upper.x ? box : Bounds{};
    for (int axis = 0; axis < 3; ++axis) fitAxis(node, axis, fitted, children);
}

}  // namespace

std::vector<BvhNode> makeNodes(const WideTree& tree) {
    std::vector<BvhNode> nodes(tree.nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        BvhNode& node = nodes[n];
        std::uint32_t inner = 0, items = 0;
        for (int slot = 0; slot < 8; ++slot) {
            const WideChild& child = tree.nodes[n].slots[std::size_t(slot)];
            if (child.node != 0) {
                if (inner++ == 0) node.children = child.node;
                node.exponents |= 1u << (24 + slot);
                setByte(node.meta, slot, kernels::kBvhInnerMeta + std::uint32_t(slot));
            } else if (child.count > 0) {
                if (items == 0) node.leaves = child.first;
                setByte(node.meta, slot, (((1u << child.count) - 1u) << 5u) | items);
                items += child.count;
            }
        }
    }
    return nodes;
}

Bounds fitNodes(std::vector<BvhNode>& nodes, const std::function<Bounds(std::uint32_t)>& itemBox) {
    std::vector<Bounds> boxes(nodes.size(), kNothing);
    for (std::size_t n = nodes.size(); n-- > 0;) {
        BvhNode& node = nodes[n];
        std::array<Bounds, 8> children;
        std::uint32_t inner = 0;
        for (int slot = 0; slot < 8; ++slot) {
            const std::uint32_t meta = metaOf(node, slot);
            Bounds& child = children[std::size_t(slot)];
            child = kNothing;
            if ((node.exponents >> (24 + slot) & 1u) != 0)
                child = boxes[node.children + inner++];
            else
                for (std::uint32_t k = 0; (meta >> (5 + k)) != 0; ++k)
                    child = united(child, itemBox(node.leaves + (meta & 31u) + k));
            boxes[n] = united(boxes[n], child);
        }
        fitNode(node, boxes[n], children);
    }
    if (boxes.empty() || boxes[0].lower.x > boxes[0].upper.x) return {};
    return boxes[0];
}

}  // namespace probegi
