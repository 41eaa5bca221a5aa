#include "bvh/binary_tree.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>

#include "core/context_impl.h"

namespace probegi {

namespace {

struct DeviceRelease {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
};
struct BvhRelease {
    void operator()(RTCBVH bvh) const noexcept { rtcReleaseBVH(bvh); }
};

/// What Embree's builder makes of a split or an item; its boxes are not kept, they follow from the items'.
struct EmbreeNode {
    EmbreeNode* children[2];  ///< null: a leaf
    unsigned item;
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(EmbreeNode), alignof(EmbreeNode))) EmbreeNode{};
}

void setChildren(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count && i < 2; ++i)
        static_cast<EmbreeNode*>(node)->children[i] = static_cast<EmbreeNode*>(children[i]);
}

void setBounds(void*, const RTCBounds**, unsigned, void*) {}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t, void*) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(EmbreeNode), alignof(EmbreeNode))) EmbreeNode{};
    leaf->item = primitives[0].primID;
    return leaf;
}

/// Depth that the heuristic may use before it must halve; what is deeper is caught when the tree is collapsed.
constexpr unsigned kMaxDepth = 192;

RTCBuildArguments buildArguments(std::vector<RTCBuildPrimitive>& primitives, RTCBVH bvh) {
    RTCBuildArguments args = rtcDefaultBuildArguments();
    args.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    args.maxBranchingFactor = 2;
    args.maxDepth = kMaxDepth;
    args.minLeafSize = args.maxLeafSize = 1;
    args.bvh = bvh;
    args.primitives = primitives.data();
    args.primitiveCount = args.primitiveArrayCapacity = primitives.size();
    args.createNode = createNode;
    args.setNodeChildren = setChildren;
    args.setNodeBounds = setBounds;
    args.createLeaf = createLeaf;
    return args;
}

/// Joins the two last subtrees, of which `left` is the first.
std::uint32_t join(BinaryTree& tree, std::uint32_t left, std::uint32_t right) {
    const BinaryNode &a = tree.nodes[left], &b = tree.nodes[right];
    const BinaryNode parent{united(a.box, b.box), a.first, a.count + b.count, left, right};
    tree.nodes.push_back(parent);
    return std::uint32_t(tree.nodes.size()) - 1;
}

std::uint32_t appendLeaf(BinaryTree& tree, const BuildItem& item) {
    tree.nodes.push_back({item.box, std::uint32_t(tree.order.size()), 1});
    tree.order.push_back(item.id);
    return std::uint32_t(tree.nodes.size()) - 1;
}

std::uint32_t flatten(BinaryTree& tree, const EmbreeNode& node, std::span<const BuildItem> items) {
    if (!node.children[0]) return appendLeaf(tree, items[node.item]);
    const std::uint32_t left = flatten(tree, *node.children[0], items);
    return join(tree, left, flatten(tree, *node.children[1], items));
}

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

BinaryTree emptyTree(std::size_t items) {
    BinaryTree tree;
    tree.nodes.reserve(2 * items);
    tree.order.reserve(items);
    return tree;
}

}  // namespace

Result<BinaryTree> buildBinaryTree(const Context& context, std::span<const BuildItem> items) {
    const std::unique_ptr<RTCDeviceTy, DeviceRelease> device(rtcNewDevice(nullptr));
    if (!device)
        return fail(ErrorCode::invalidArgument, "Embree could not make a device; is this processor supported?");
    const std::unique_ptr<RTCBVHTy, BvhRelease> bvh(rtcNewBVH(device.get()));
    std::vector<RTCBuildPrimitive> primitives(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Bounds& box = items[i].box;
        primitives[i] = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, unsigned(i)};
    }
    const RTCBuildArguments args = buildArguments(primitives, bvh.get());
    void* root = nullptr;
    // Within the arena Embree's tasks keep to the context's threads.
    context.impl().arena.execute([&] { root = rtcBuildBVH(&args); });
    const RTCError error = rtcGetDeviceError(device.get());
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        return fail(ErrorCode::outOfMemory, "not enough memory to build the BVH; use fewer triangles");
    // Too deep for Embree, or an error that it has no name for: a flat tree is always possible.
    if (!root) return buildBalancedTree(items);
    BinaryTree tree = emptyTree(items.size());
    flatten(tree, *static_cast<const EmbreeNode*>(root), items);
    return tree;
}

BinaryTree buildBalancedTree(std::span<const BuildItem> items) {
    std::vector<BuildItem> sorted(items.begin(), items.end());
    BinaryTree tree = emptyTree(items.size());
    halve(tree, sorted);
    return tree;
}

}  // namespace probegi
