#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "kernels/trace/bvh_scene.h"
#include "probegi/context.h"
#include "probegi/scene.h"

// The bounding volume hierarchy of the compute-shader tracer: eight children a node, their boxes quantised to a byte a
// plane, 80 bytes (Ylitie, Karras, Laine 2017). Rays in a GPU wait for memory, so a node brings much in few bytes, and
// the traversal keeps one stack entry a level. Embree's builder API makes a binary tree by the surface area heuristic,
// one triangle a leaf; a dynamic program then chooses the wide nodes and leaves of least expected cost (collapse.h).
// There are no spatial splits: each triangle stands in one leaf, so moved triangles can be refitted. Text that both
// languages share: kernels/trace/bvh_node.h, bvh_scene.h, triangle_hit.h, bvh_traverse.h.
namespace probegi {

/// Indexed triangles somewhere in memory, read in place. Entries lie `stride` bytes apart, in any struct.
struct TriangleSoup {
    const void* positions = nullptr;  ///< three floats each
    std::size_t positionStride = 3 * sizeof(float);
    std::size_t positionCount = 0;
    const void* triangles = nullptr;  ///< three 32-bit indices into the positions each
    std::size_t triangleStride = 3 * sizeof(std::uint32_t);
    std::size_t triangleCount = 0;
};

/// A tree over triangles: the world's, or those of one group that instances place. Empty: no nodes.
struct TriangleBvh {
    std::vector<kernels::BvhNode> nodes;          ///< the root first, parents before children
    std::vector<kernels::BvhTriangle> triangles;  ///< in the order of the leaves
    Bounds bounds;                                ///< of what can be hit; zero-sized where nothing can
    int levels = 0;                               ///< of nodes, <= kernels::kBvhTriangleLevels
};

/// A tree over the world-space boxes of instances. Leaves index BvhInstances in the order of `order`.
struct InstanceBvh {
    std::vector<kernels::BvhNode> nodes;
    std::vector<std::uint32_t> order;  ///< number of the box (instance) at each place of the leaves
    Bounds bounds;
    int levels = 0;  ///< <= kernels::kBvhInstanceLevels
};

/// `opaque` and `masked` are geometry 0 and 1 of the hits. Left out, since no ray can hit them: triangles without area,
/// with a corner that is not finite or beyond 1.8e18 (as in Embree: squares must not overflow), or with an index beyond
/// the positions. Errors: outOfMemory, invalidArgument (more than 2^31 triangles, or no Embree on this processor).
Result<TriangleBvh> buildTriangleBvh(const Context& context, const TriangleSoup& opaque, const TriangleSoup& masked);

/// Boxes that are not finite or inside out are left out. Errors as above, and invalidArgument where
/// kernels::kBvhInstanceLevels cannot hold them (some 8^9 boxes).
Result<InstanceBvh> buildInstanceBvh(const Context& context, std::span<const Bounds> boxes);

/// Moved triangles or boxes: same soups in number and indices, same topology, new planes. What was left out stays out;
/// a triangle that became degenerate is hit no more. Costs a pass over the nodes; a tree that was refitted far from
/// where it was built is slower to trace, never wrong.
void refit(TriangleBvh& bvh, const TriangleSoup& opaque, const TriangleSoup& masked);
void refit(InstanceBvh& bvh, std::span<const Bounds> boxes);

/// All trees of a scene in two arrays, as the traversal reads them.
struct BvhArrays {
    std::vector<kernels::BvhNode> nodes;
    std::vector<kernels::BvhTriangle> triangles;

    /// Appends a tree and returns its root; kernels::kBvhNone for an empty one.
    std::uint32_t append(const TriangleBvh& bvh);
    /// `firstInstance`: where bvh.order begins in the array of BvhInstances.
    std::uint32_t append(const InstanceBvh& bvh, std::uint32_t firstInstance = 0);
};

/// A placement of a group. `toWorld` must be invertible.
kernels::BvhInstance makeBvhInstance(const glm::mat4& toWorld, std::uint32_t root, int number);

/// World-space box of a placed box, rounded outwards.
Bounds placedBounds(const Bounds& bounds, const glm::mat4& toWorld);

}  // namespace probegi
