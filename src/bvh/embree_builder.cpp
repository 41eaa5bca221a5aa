#include <memory>
#include <new>

#include "bvh/tree_parts.h"
#include "core/embree.h"
#include "core/parallel.h"

namespace probegi {

namespace {

struct DeviceRelease {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
};
struct BvhRelease {
    void operator()(RTCBVH bvh) const noexcept { rtcReleaseBVH(bvh); }
};

/// Node of Embree's builder, a split or an item. Boxes are not kept; they follow from the items'.
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

/// Maximum depth before Embree switches to median splits; deeper trees are caught when collapsing.
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

std::uint32_t flatten(BinaryTree& tree, const EmbreeNode& node, std::span<const BuildItem> items) {
    if (!node.children[0]) return appendLeaf(tree, items[node.item]);
    const std::uint32_t left = flatten(tree, *node.children[0], items);
    return join(tree, left, flatten(tree, *node.children[1], items));
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
    // Within the arena Embree's tasks use the context's threads.
    runInside(context, [&] { root = rtcBuildBVH(&args); });
    const RTCError error = rtcGetDeviceError(device.get());
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        return fail(ErrorCode::outOfMemory, "not enough memory to build the BVH; use fewer triangles");
    // Too deep for Embree, or an unknown error: a balanced tree is always possible.
    if (!root) return buildBalancedTree(items);
    BinaryTree tree = emptyTree(items.size());
    flatten(tree, *static_cast<const EmbreeNode*>(root), items);
    return tree;
}

bool treesFollowAHeuristic() noexcept {
    return true;
}

}  // namespace probegi
