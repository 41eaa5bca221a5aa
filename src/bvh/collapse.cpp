#include "bvh/collapse.h"

#include <algorithm>

namespace probegi {

namespace {

constexpr int kWidth = 8;

/// The choice for a binary node. `leftShare[i]`: of up to i roots, how many it gives to its left child, the rest to the
/// right; 0: it needs at most i - 1.
struct Choice {
    bool leaf = false;
    std::array<std::uint8_t, kWidth + 1> leftShare{};
};

/// Half the surface; doubles, since areas of large scenes overflow a float.
double area(const Bounds& box) {
    const glm::dvec3 s = glm::dvec3(box.upper) - glm::dvec3(box.lower);
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

using Costs = std::array<double, kWidth>;  // C(n, i) of the paper at i, 1..7

/// C_distribute(n, roots), eq. 4.
double distribute(const Costs& left, const Costs& right, int roots, std::uint8_t& leftShare) {
    double best = std::numeric_limits<double>::infinity();
    for (int k = 1; k < roots; ++k) {
        const double cost = left[std::size_t(k)] + right[std::size_t(roots - k)];
        if (cost >= best) continue;
        best = cost;
        leftShare = std::uint8_t(k);
    }
    return best;
}

/// The dynamic program of section 3.3, eqs. 2 to 4.
std::vector<Choice> cheapestChoices(const BinaryTree& tree, const CollapseCosts& costs) {
    std::vector<Choice> choices(tree.nodes.size());
    std::vector<Costs> table(tree.nodes.size());
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
        const BinaryNode& node = tree.nodes[n];
        Choice& choice = choices[n];
        const double here = area(node.box);
        const double asLeaf = here * double(node.count) * double(costs.leafItem);
        if (node.count == 1) {
            choice.leaf = true;
            table[n].fill(asLeaf);
            continue;
        }
        const Costs &left = table[node.left], &right = table[node.right];
        const double asNode = here + distribute(left, right, kWidth, choice.leftShare[kWidth]);
        choice.leaf = int(node.count) <= costs.maxLeafSize && asLeaf <= asNode;
        table[n][1] = choice.leaf ? asLeaf : asNode;
        for (int i = 2; i < kWidth; ++i) {
            std::uint8_t share = 0;
            const double split = distribute(left, right, i, share);
            const double fewer = table[n][std::size_t(i) - 1];
            choice.leftShare[std::size_t(i)] = split < fewer ? share : std::uint8_t(0);
            table[n][std::size_t(i)] = std::min(split, fewer);
        }
    }
    return choices;
}

class Emitter {
public:
    Emitter(const BinaryTree& tree, std::span<const Choice> choices) : m_tree(tree), m_choices(choices) {
        const auto root = std::uint32_t(tree.nodes.size()) - 1;
        m_wide.order.reserve(tree.order.size());
        m_wide.nodes.push_back({tree.nodes[root].box});
        emit(root, 0, 1);
    }
    WideTree take() { return std::move(m_wide); }

private:
    struct Roots {
        std::array<std::uint32_t, kWidth> node;
        int count = 0;
    };

    /// Collects up to `share` roots that replace `node`.
    void gather(std::uint32_t node, int share, Roots& roots) const {
        const Choice& choice = m_choices[node];
        while (share > 1 && share < kWidth && choice.leftShare[std::size_t(share)] == 0) --share;
        if (share == 1) {
            roots.node[std::size_t(roots.count++)] = node;
            return;
        }
        const int left = choice.leftShare[std::size_t(share)];
        gather(m_tree.nodes[node].left, left, roots);
        gather(m_tree.nodes[node].right, share - left, roots);
    }

    using Slots = std::array<int, kWidth>;  // root in each slot; -1: none

    /// Section 3.2: bit a of a slot's number means that its child lies towards +a. Greedy, then improved by swaps.
    Slots assignSlots(const Roots& roots, glm::vec3 centre) const {
        std::array<std::array<float, kWidth>, kWidth> gain{};  // [root][slot]
        for (int r = 0; r < roots.count; ++r) {
            const glm::vec3 towards = m_tree.nodes[roots.node[std::size_t(r)]].box.centre() - centre;
            for (int s = 0; s < kWidth; ++s)
                gain[std::size_t(r)][std::size_t(s)] = ((s & 1) != 0 ? towards.x : -towards.x) +
                                                       ((s & 2) != 0 ? towards.y : -towards.y) +
                                                       ((s & 4) != 0 ? towards.z : -towards.z);
        }
        const auto at = [&](int root, int slot) {
            return root < 0 ? 0.0f : gain[std::size_t(root)][std::size_t(slot)];
        };
        Slots slots;
        slots.fill(-1);
        for (int r = 0; r < roots.count; ++r) {
            int best = -1;
            for (int s = 0; s < kWidth; ++s)
                if (slots[std::size_t(s)] < 0 && (best < 0 || at(r, s) > at(r, best))) best = s;
            slots[std::size_t(best)] = r;
        }
        bool better = true;
        for (int round = 0; better && round < kWidth; ++round) {
            better = false;
            for (int s = 0; s < kWidth; ++s) {
                for (int t = s + 1; t < kWidth; ++t) {
                    int &a = slots[std::size_t(s)], &b = slots[std::size_t(t)];
                    if (at(a, t) + at(b, s) <= at(a, s) + at(b, t)) continue;
                    std::swap(a, b);
                    better = true;
                }
            }
        }
        return slots;
    }

    void fillLeaf(WideChild& child, const BinaryNode& leaf) {
        child.first = std::uint32_t(m_wide.order.size());
        child.count = leaf.count;
        const auto first = m_tree.order.begin() + std::ptrdiff_t(leaf.first);
        m_wide.order.insert(m_wide.order.end(), first, first + std::ptrdiff_t(leaf.count));
    }

    void emit(std::uint32_t node, std::size_t place, int level) {
        m_wide.levels = std::max(m_wide.levels, level);
        Roots roots;
        if (m_tree.nodes[node].count == 1 || (level == 1 && m_choices[node].leaf))
            roots = {{node}, 1};  // a tree's root is a node even if a leaf would do
        else
            gather(node, kWidth, roots);
        const Slots slots = assignSlots(roots, m_tree.nodes[node].box.centre());
        std::array<std::uint32_t, kWidth> inner{};
        for (std::size_t s = 0; s < std::size_t(kWidth); ++s) {
            if (slots[s] < 0) continue;
            const std::uint32_t root = roots.node[std::size_t(slots[s])];
            WideChild child{.box = m_tree.nodes[root].box};
            if (m_choices[root].leaf) {
                fillLeaf(child, m_tree.nodes[root]);
            } else {
                child.node = inner[s] = std::uint32_t(m_wide.nodes.size());
                m_wide.nodes.push_back({child.box});
            }
            m_wide.nodes[place].slots[s] = child;
        }
        for (std::size_t s = 0; s < std::size_t(kWidth); ++s)
            if (inner[s] != 0) emit(roots.node[std::size_t(slots[s])], inner[s], level + 1);
    }

    const BinaryTree& m_tree;
    std::span<const Choice> m_choices;
    WideTree m_wide;
};

}  // namespace

WideTree collapse(const BinaryTree& tree, const CollapseCosts& costs) {
    return Emitter(tree, cheapestChoices(tree, costs)).take();
}

WideTree collapseByLevels(const BinaryTree& balanced, int maxLeafSize) {
    std::vector<Choice> choices(balanced.nodes.size());
    for (std::size_t n = 0; n < choices.size(); ++n) {
        choices[n].leaf = int(balanced.nodes[n].count) <= maxLeafSize;
        // A leaf stays whole; everything else is divided evenly.
        if (!choices[n].leaf) choices[n].leftShare = {0, 0, 1, 0, 2, 0, 0, 0, 4};
    }
    return Emitter(balanced, choices).take();
}

}  // namespace probegi
