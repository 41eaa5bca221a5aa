// Invariants of every tree: each item is in one leaf, and quantised boxes enclose everything below them.
#include <gmock/gmock.h>

#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <set>

#include "bvh/collapse.h"
#include "bvh/soups.h"

namespace probegi::test {

namespace {

using kernels::BvhNode;

std::uint32_t byteAt(glm::uvec2 words, int slot) {
    return words[slot / 4] >> (8 * (slot % 4)) & 255u;
}

/// A child's box as stored, decoded independently of the traversal.
struct Decoded {
    glm::dvec3 lower, upper;

    Decoded(const BvhNode& node, int slot) : lower(node.origin), upper(node.origin) {
        const glm::uvec2 lowers[] = {node.lowerX, node.lowerY, node.lowerZ};
        const glm::uvec2 uppers[] = {node.upperX, node.upperY, node.upperZ};
        for (int axis = 0; axis < 3; ++axis) {
            const double step = std::ldexp(1.0, int(node.exponents >> (8 * axis) & 255u) - 127);
            lower[axis] += byteAt(lowers[axis], slot) * step;
            upper[axis] += byteAt(uppers[axis], slot) * step;
        }
    }
    bool contains(glm::vec3 p) const {
        const glm::dvec3 q(p);
        return glm::all(glm::lessThanEqual(lower, q)) && glm::all(glm::lessThanEqual(q, upper));
    }
};

/// Walks a tree, checks every node, and counts how often each leaf entry occurs.
struct Walk {
    const std::vector<BvhNode>& nodes;
    std::vector<std::vector<glm::vec3>> itemCorners = {};  ///< by leaf entry
    std::vector<int> visits = {};
    std::size_t nodesSeen = 0;
    int levels = 0;

    void node(std::uint32_t index, int level, std::vector<Decoded> around) {
        ASSERT_LT(index, nodes.size());
        ++nodesSeen;
        levels = std::max(levels, level);
        const BvhNode& n = nodes[index];
        std::uint32_t inner = 0;
        for (int slot = 0; slot < 8; ++slot) {
            const std::uint32_t meta = byteAt(n.meta, slot);
            if (meta == 0) continue;
            around.emplace_back(n, slot);
            if ((meta & 31u) >= 24u) {
                EXPECT_EQ(meta, kernels::kBvhInnerMeta + std::uint32_t(slot));
                EXPECT_TRUE(n.exponents >> (24 + slot) & 1u);
                ASSERT_GT(n.children + inner, index) << "parents stand before their children";
                node(n.children + inner++, level + 1, around);
            } else {
                EXPECT_FALSE(n.exponents >> (24 + slot) & 1u);
                for (std::uint32_t bits = meta >> 5u, k = 0; bits != 0; bits >>= 1u, ++k)
                    leaf(n.leaves + (meta & 31u) + k, around);
            }
            around.pop_back();
        }
    }
    void leaf(std::uint32_t place, const std::vector<Decoded>& around) {
        ASSERT_LT(place, visits.size());
        ++visits[place];
        for (const glm::vec3& corner : itemCorners[place])
            for (const Decoded& box : around) EXPECT_TRUE(box.contains(corner)) << place;
    }
};

void checkTriangles(const TriangleBvh& bvh, std::size_t expected) {
    Walk walk{bvh.nodes};
    std::map<std::pair<int, int>, int> primitives;
    for (const kernels::BvhTriangle& t : bvh.triangles) {
        walk.itemCorners.push_back({t.corner0, t.corner1, t.corner2});
        ++primitives[{t.geometry, t.primitive}];
    }
    walk.visits.assign(bvh.triangles.size(), 0);
    EXPECT_EQ(bvh.triangles.size(), expected);
    EXPECT_EQ(primitives.size(), expected) << "a triangle stands twice";
    if (expected == 0) {
        EXPECT_TRUE(bvh.nodes.empty());
        return;
    }
    walk.node(0, 1, {});
    EXPECT_THAT(walk.visits, testing::Each(1));
    EXPECT_EQ(walk.nodesSeen, bvh.nodes.size());
    EXPECT_EQ(walk.levels, bvh.levels);
    EXPECT_LE(bvh.levels, kernels::kBvhTriangleLevels);
}

bool samePlanes(const BvhNode& a, const BvhNode& b) {
    return a.origin == b.origin && a.exponents == b.exponents && a.children == b.children && a.leaves == b.leaves &&
           a.meta == b.meta && a.lowerX == b.lowerX && a.lowerY == b.lowerY && a.lowerZ == b.lowerZ &&
           a.upperX == b.upperX && a.upperY == b.upperY && a.upperZ == b.upperZ;
}

Bounds boundsOf(const SceneTriangles& soup) {
    Bounds b{soup.positions[0], soup.positions[0]};
    for (const glm::vec3& p : soup.positions) b = {glm::min(b.lower, p), glm::max(b.upper, p)};
    return b;
}

}  // namespace

TEST(BvhStructure, NodesAreAsLongAsTheGpuReadsThem) {
    EXPECT_EQ(sizeof(kernels::BvhNode), 80u);
    EXPECT_EQ(sizeof(kernels::BvhTriangle), 48u);
    EXPECT_EQ(sizeof(kernels::BvhInstance), 64u);
    EXPECT_EQ(offsetof(kernels::BvhNode, meta), 24u);
    EXPECT_EQ(offsetof(kernels::BvhNode, upperZ), 72u);
}

TEST(BvhStructure, EachTriangleInOneLeafAndBoxesAroundIt) {
    std::mt19937 random(1);
    for (const int count : {0, 1, 2, 3, 4, 7, 8, 9, 24, 25, 100, 3000}) {
        SCOPED_TRACE(count);
        const SceneTriangles opaque = randomSoup(random, count), masked = randomSoup(random, count / 2);
        const TriangleBvh bvh = buildTriangleBvh(makeContext(2), opaque.soup(), masked.soup()).value();
        checkTriangles(bvh, std::size_t(count + count / 2));
    }
}

TEST(BvhStructure, HugeTinyAndFarApart) {
    std::mt19937 random(2);
    for (const float scale : {1e-15f, 1e-3f, 1e6f, 1e17f}) {
        SCOPED_TRACE(scale);
        SceneTriangles soup = randomSoup(random, 300);
        for (glm::vec3& p : soup.positions) p *= scale;
        checkTriangles(buildOpaque(soup), 300);
        for (glm::vec3& p : soup.positions) p += glm::vec3(10, 0, -5) * scale;
        const TriangleBvh far = buildOpaque(soup);
        checkTriangles(far, far.triangles.size());
        EXPECT_GT(far.triangles.size(), 250u);
    }
}

TEST(BvhStructure, IdenticalTrianglesShareNoLeafBeyondItsSize) {
    for (const int count : {10, 100, 5000}) {
        SceneTriangles soup;
        for (int i = 0; i < count; ++i) addTriangle(soup, {0, 0, 0}, {1, 0, 0.5f}, {0, 1, 0.25f});
        checkTriangles(buildOpaque(soup), std::size_t(count));
    }
}

TEST(BvhStructure, DeepTreesStayWithinTheStack) {
    // Each triangle is half as large as the one before and inside its box: the heuristic splits them off one by one.
    SceneTriangles soup;
    for (int i = 0; i < 20000; ++i) {
        const float s = std::exp2(-0.005f * float(i));
        addTriangle(soup, {0, 0, 0}, {s, 0, 0.1f * s}, {0, s, 0.2f * s});
    }
    const TriangleBvh bvh = buildOpaque(soup);
    checkTriangles(bvh, bvh.triangles.size());
    EXPECT_GT(bvh.triangles.size(), 19000u);
}

TEST(BvhStructure, BalancedTreesAreAsFlatAsTheyCanBe) {
    std::mt19937 random(9);
    for (const std::size_t count : {std::size_t(1), std::size_t(8), std::size_t(9), std::size_t(3000)}) {
        std::vector<BuildItem> items;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 p = randomIn(random, 1.0f);
            items.push_back({{p, p}, std::uint32_t(i)});
        }
        for (const int leaf : {1, 3}) {
            const WideTree tree = collapseByLevels(buildBalancedTree(items), leaf);
            EXPECT_EQ(tree.levels, count <= 8 ? 1 : count <= 9 ? 3 - (leaf == 3 ? 2 : 1) : 4);
            EXPECT_EQ(std::set<std::uint32_t>(tree.order.begin(), tree.order.end()).size(), count);
        }
    }
}

TEST(BvhStructure, BoundsAreTheTriangles) {
    std::mt19937 random(3);
    const SceneTriangles soup = randomSoup(random, 50);
    EXPECT_EQ(buildOpaque(soup).bounds.lower, boundsOf(soup).lower);
    EXPECT_EQ(buildOpaque(soup).bounds.upper, boundsOf(soup).upper);
    EXPECT_EQ(buildOpaque({}).bounds.size(), glm::vec3(0.0f));
}

TEST(BvhStructure, UnusableTrianglesAreLeftOut) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    SceneTriangles soup;
    addTriangle(soup, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addTriangle(soup, {kNan, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addTriangle(soup, {0, 0, 0}, {1, kInf, 0}, {0, 1, 0});
    addTriangle(soup, {0, 0, 0}, {1, 0, 0}, {0, 1, -1e30f});
    addTriangle(soup, {0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    addTriangle(soup, {1, 2, 3}, {1, 2, 3}, {1, 2, 3});
    addTriangle(soup, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    soup.indices.back() = 1000;
    addTriangle(soup, {0, 0, 5}, {1, 0, 5}, {0, 1, 5});
    const TriangleBvh bvh = buildOpaque(soup);
    checkTriangles(bvh, 2);
    EXPECT_EQ(std::min(bvh.triangles[0].primitive, bvh.triangles[1].primitive), 0);
    EXPECT_EQ(std::max(bvh.triangles[0].primitive, bvh.triangles[1].primitive), 7);
    EXPECT_EQ(bvh.bounds.upper, glm::vec3(1, 1, 5));
}

TEST(BvhStructure, RefitOfWhatDidNotMoveChangesNothing) {
    std::mt19937 random(4);
    const SceneTriangles soup = randomSoup(random, 500);
    const TriangleBvh built = buildOpaque(soup);
    TriangleBvh refitted = built;
    refit(refitted, soup.soup(), {});
    for (std::size_t i = 0; i < built.nodes.size(); ++i) EXPECT_TRUE(samePlanes(built.nodes[i], refitted.nodes[i]));
}

TEST(BvhStructure, RefitBoundsMovedTriangles) {
    std::mt19937 random(5);
    SceneTriangles soup = randomSoup(random, 500);
    TriangleBvh bvh = buildOpaque(soup);
    for (glm::vec3& p : soup.positions) p = 3.0f * p + randomIn(random, 0.5f);
    refit(bvh, soup.soup(), {});
    checkTriangles(bvh, 500);
    EXPECT_EQ(bvh.bounds.lower, boundsOf(soup).lower);
    EXPECT_EQ(bvh.bounds.upper, boundsOf(soup).upper);
}

TEST(BvhStructure, RefitShrinksWhatCannotBeHitAnyMore) {
    SceneTriangles soup;
    for (int i = 0; i < 20; ++i) addTriangle(soup, {i, 0, 0}, {i + 1, 0, 0}, {i, 1, 0});
    TriangleBvh bvh = buildOpaque(soup);
    for (std::size_t i = 0; i < 57; ++i) soup.positions[i] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    refit(bvh, soup.soup(), {});
    EXPECT_EQ(bvh.bounds.lower, glm::vec3(19, 0, 0));
    const TracedWorld world = worldOf(bvh);
    EXPECT_EQ(closestHit(world, {{19.25f, 0.25f, 1}, 0, {0, 0, -1}, 1e30f}).primitive, 19);
    EXPECT_FALSE(closestHit(world, {{3.25f, 0.25f, 1}, 0, {0, 0, -1}, 1e30f}).valid());
    for (glm::vec3& p : soup.positions) p = glm::vec3(0.0f);
    refit(bvh, soup.soup(), {});
    EXPECT_EQ(bvh.bounds.size(), glm::vec3(0.0f));
    EXPECT_FALSE(closestHit(worldOf(bvh), {{0, 0, 1}, 0, {0, 0, -1}, 1e30f}).valid());
}

TEST(BvhStructure, InstanceBoxes) {
    std::mt19937 random(6);
    std::vector<Bounds> boxes;
    for (int i = 0; i < 700; ++i) {
        const glm::vec3 p = randomIn(random, 10.0f);
        boxes.push_back({p, p + glm::abs(randomIn(random, 1.0f))});
    }
    boxes[13].lower.x = std::numeric_limits<float>::quiet_NaN();
    boxes[14].upper.y = boxes[14].lower.y - 1.0f;
    InstanceBvh bvh = buildInstanceBvh(makeContext(), boxes).value();
    EXPECT_EQ(bvh.order.size(), 698u);
    const auto check = [&] {
        Walk walk{bvh.nodes};
        for (const std::uint32_t i : bvh.order) walk.itemCorners.push_back({boxes[i].lower, boxes[i].upper});
        walk.visits.assign(bvh.order.size(), 0);
        walk.node(0, 1, {});
        EXPECT_THAT(walk.visits, testing::Each(1));
        EXPECT_LE(bvh.levels, kernels::kBvhInstanceLevels);
    };
    check();
    for (Bounds& box : boxes) box = {box.lower * 2.0f, box.upper * 2.0f};
    for (Bounds& box : boxes) box.upper = glm::max(box.lower, box.upper);
    refit(bvh, boxes);
    check();
    EXPECT_TRUE(buildInstanceBvh(makeContext(), {})->nodes.empty());
}

TEST(BvhStructure, PlacedBoundsHoldThePlacedCorners) {
    std::mt19937 random(7);
    for (int i = 0; i < 100; ++i) {
        const Bounds box{glm::vec3(-1, -2, -3), glm::vec3(4, 5, 6)};
        const glm::mat4 m =
            glm::rotate(glm::translate(glm::mat4(1.0f), randomIn(random, 100.0f)), float(i), randomUnit(random));
        const Bounds placed = placedBounds(box, m);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 p(corner & 1 ? 4 : -1, corner & 2 ? 5 : -2, corner & 4 ? 6 : -3, 1);
            const glm::dvec3 q(glm::dmat4(m) * p);
            EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::dvec3(placed.lower), q)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(q, glm::dvec3(placed.upper))));
        }
    }
}

}  // namespace probegi::test
