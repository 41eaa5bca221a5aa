#include "bvh/wide_bvh.h"

#include <cmath>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <limits>
#include <new>

#include "bvh/quantise.h"
#include "core/sentence.h"

namespace probegi {

namespace {

using kernels::BvhNode;
using kernels::BvhTriangle;

/// Embree's limit: squares of twice this are finite.
constexpr float kLargest = 1.844e18f;

bool usable(const glm::vec3& p) {
    return std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest && std::abs(p.z) <= kLargest;  // false for NaN
}

struct Corners {
    glm::vec3 corner[3];

    Bounds box() const {
        return {glm::min(corner[0], glm::min(corner[1], corner[2])),
                glm::max(corner[0], glm::max(corner[1], corner[2]))};
    }
    bool canBeHit() const {
        if (!usable(corner[0]) || !usable(corner[1]) || !usable(corner[2])) return false;
        const glm::dvec3 a(corner[0]);
        return glm::cross(glm::dvec3(corner[1]) - a, glm::dvec3(corner[2]) - a) != glm::dvec3(0.0);
    }
};

/// False if an index is out of range.
bool readCorners(const TriangleSoup& soup, std::size_t triangle, Corners& out) {
    std::uint32_t index[3];
    std::memcpy(index, static_cast<const std::byte*>(soup.triangles) + triangle * soup.triangleStride, sizeof index);
    for (int k = 0; k < 3; ++k) {
        if (index[k] >= soup.positionCount) return false;
        std::memcpy(&out.corner[k], static_cast<const std::byte*>(soup.positions) + index[k] * soup.positionStride,
                    sizeof(glm::vec3));
    }
    return true;
}

/// The triangle in the traversal's format; one that cannot be hit is collapsed to a point.
BvhTriangle makeTriangle(const TriangleSoup& soup, int primitive, int geometry) {
    Corners c{};
    if (!readCorners(soup, std::size_t(primitive), c) || !c.canBeHit()) c = {};
    return {c.corner[0], primitive, c.corner[1], geometry, c.corner[2], 0};
}

Bounds triangleBox(const BvhTriangle& t) {
    if (t.corner0 == t.corner1 && t.corner0 == t.corner2) return kNothing;
    return Corners{{t.corner0, t.corner1, t.corner2}}.box();
}

bool usable(const Bounds& box) {
    return usable(box.lower) && usable(box.upper) && box.lower.x <= box.upper.x && box.lower.y <= box.upper.y &&
           box.lower.z <= box.upper.z;
}

/// The paper's. From 0.15 to 1.2 nothing changes by more than a few per cent on Sponza except the number of nodes (a
/// third).
constexpr CollapseCosts kTriangleCosts{.leafItem = 0.3f, .maxLeafSize = int(kernels::kBvhLeafSize)};
/// An instance costs at least the visit of a root.
constexpr CollapseCosts kInstanceCosts{.leafItem = 1.5f, .maxLeafSize = 1};

Result<WideTree> buildWideTree(const Context& context, std::span<const BuildItem> items, const CollapseCosts& costs,
                               int maxLevels) {
    const Result<BinaryTree> binary = buildBinaryTree(context, items);
    if (!binary) return binary.error();
    WideTree wide = collapse(*binary, costs);
    if (wide.levels > maxLevels) wide = collapseByLevels(buildBalancedTree(items), costs.maxLeafSize);
    if (wide.levels > maxLevels)
        return fail(ErrorCode::invalidArgument,
                    sentence(items.size(), " triangles or instances are too many for the BVH; use fewer"));
    return wide;
}

/// Appends triangles of two geometries with distinct ids.
void appendItems(std::vector<BuildItem>& items, const TriangleSoup& soup, std::uint32_t firstId) {
    Corners c{};
    for (std::size_t i = 0; i < soup.triangleCount; ++i)
        if (readCorners(soup, i, c) && c.canBeHit()) items.push_back({c.box(), firstId + std::uint32_t(i)});
}

}  // namespace

Result<TriangleBvh> buildTriangleBvh(const Context& context, const TriangleSoup& opaque,
                                     const TriangleSoup& masked) try {
    if (opaque.triangleCount + masked.triangleCount > std::size_t(std::numeric_limits<std::int32_t>::max()))
        return fail(ErrorCode::invalidArgument, "more than 2^31 triangles; use fewer");
    std::vector<BuildItem> items;
    items.reserve(opaque.triangleCount + masked.triangleCount);
    const auto firstMasked = std::uint32_t(opaque.triangleCount);
    appendItems(items, opaque, 0);
    appendItems(items, masked, firstMasked);
    TriangleBvh bvh;
    if (items.empty()) return bvh;
    const Result<WideTree> tree = buildWideTree(context, items, kTriangleCosts, kernels::kBvhTriangleLevels);
    if (!tree) return tree.error();
    bvh.levels = tree->levels;
    bvh.nodes = makeNodes(*tree);
    bvh.triangles.reserve(tree->order.size());
    for (const std::uint32_t id : tree->order)
        bvh.triangles.push_back(id < firstMasked ? makeTriangle(opaque, int(id), 0)
                                                 : makeTriangle(masked, int(id - firstMasked), 1));
    bvh.bounds = fitNodes(bvh.nodes, [&](std::uint32_t i) { return triangleBox(bvh.triangles[i]); });
    return bvh;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "not enough memory for the BVH; use fewer triangles");
}

Result<InstanceBvh> buildInstanceBvh(const Context& context, std::span<const Bounds> boxes) try {
    std::vector<BuildItem> items;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (usable(boxes[i])) items.push_back({boxes[i], std::uint32_t(i)});
    InstanceBvh bvh;
    if (items.empty()) return bvh;
    Result<WideTree> tree = buildWideTree(context, items, kInstanceCosts, kernels::kBvhInstanceLevels);
    if (!tree) return tree.error();
    bvh.levels = tree->levels;
    bvh.nodes = makeNodes(*tree);
    bvh.order = std::move(tree->order);
    refit(bvh, boxes);
    return bvh;
} catch (const std::bad_alloc&) {
    return fail(ErrorCode::outOfMemory, "not enough memory for the BVH; use fewer instances");
}

void refit(TriangleBvh& bvh, const TriangleSoup& opaque, const TriangleSoup& masked) {
    for (BvhTriangle& t : bvh.triangles) t = makeTriangle(t.geometry == 0 ? opaque : masked, t.primitive, t.geometry);
    bvh.bounds = fitNodes(bvh.nodes, [&](std::uint32_t i) { return triangleBox(bvh.triangles[i]); });
}

void refit(InstanceBvh& bvh, std::span<const Bounds> boxes) {
    bvh.bounds = fitNodes(bvh.nodes, [&](std::uint32_t i) {
        const Bounds& box = boxes[bvh.order[i]];
        return usable(box) ? box : kNothing;
    });
}

namespace {

std::uint32_t appendNodes(std::vector<BvhNode>& all, std::span<const BvhNode> nodes, std::uint32_t firstLeaf) {
    if (nodes.empty()) return kernels::kBvhNone;
    const auto root = std::uint32_t(all.size());
    for (BvhNode node : nodes) {
        node.children += root;
        node.leaves += firstLeaf;
        all.push_back(node);
    }
    return root;
}

}  // namespace

std::uint32_t BvhArrays::append(const TriangleBvh& bvh) {
    const auto first = std::uint32_t(triangles.size());
    triangles.insert(triangles.end(), bvh.triangles.begin(), bvh.triangles.end());
    return appendNodes(nodes, bvh.nodes, first);
}

std::uint32_t BvhArrays::append(const InstanceBvh& bvh, std::uint32_t firstInstance) {
    return appendNodes(nodes, bvh.nodes, firstInstance);
}

kernels::BvhInstance makeBvhInstance(const glm::mat4& toWorld, std::uint32_t root, int number) {
    // In doubles: the inverse of a small placement loses digits.
    const glm::dmat3 linear = glm::inverse(glm::dmat3(glm::dmat4(toWorld)));
    const auto row = [&](int i) { return glm::vec4(linear[0][i], linear[1][i], linear[2][i], toWorld[3][i]); };
    return {row(0), row(1), row(2), root, number, 0, 0};
}

Bounds placedBounds(const Bounds& bounds, const glm::mat4& toWorld) {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
    const glm::dvec3 reach = 0.5 * (glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
    const glm::dmat4 m(toWorld);
    Bounds placed;
    for (int axis = 0; axis < 3; ++axis) {
        double centre = m[3][axis], extent = 0.0;
        for (int k = 0; k < 3; ++k) {
            centre += m[k][axis] * middle[k];
            extent += std::abs(m[k][axis]) * reach[k];
        }
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        placed.lower[axis] = std::nextafter(float(centre - extent), -kInfinity);
        placed.upper[axis] = std::nextafter(float(centre + extent), kInfinity);
    }
    return placed;
}

}  // namespace probegi
