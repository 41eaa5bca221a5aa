#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "kernels/trace/bvh_scene.h"
#include "probegi/context.h"
#include "probegi/scene.h"

// The bounding volume hierarchy of the compute-shader tracer: eight children per node, boxes quantised to one byte per
// plane, 80 bytes (Ylitie, Karras, Laine 2017). GPU ray tracing is memory-bound, so nodes are compact, and the
// traversal keeps one stack entry per level. Embree's builder API makes a binary tree by the surface area heuristic,
// one triangle per leaf; a dynamic program then chooses the wide nodes and leaves of minimum expected cost
// (collapse.h). There are no spatial splits: each triangle is in one leaf, so trees can be refitted. Kernels shared
// with GLSL: kernels/trace/bvh_node.h, bvh_scene.h, triangle_hit.h, bvh_traverse.h.
namespace probegi {

/// Indexed triangles, read in place. Entries are `stride` bytes apart, in any struct.
struct TriangleSoup {
    const void* positions = nullptr;  ///< three floats each
    std::size_t positionStride = 3 * sizeof(float);
    std::size_t positionCount = 0;
    const void* triangles = nullptr;  ///< three 32-bit indices into positions each
    std::size_t triangleStride = 3 * sizeof(std::uint32_t);
    std::size_t triangleCount = 0;
};

/// A tree over triangles: the world's, or those of an instanced group. Empty: no nodes.
struct TriangleBvh {
    std::vector<kernels::BvhNode> nodes;          ///< the root first, parents before children
    std::vector<kernels::BvhTriangle> triangles;  ///< in the order of the leaves
    Bounds bounds;                                ///< of what can be hit; zero-sized where nothing can
    int levels = 0;                               ///< of nodes, <= kernels::kBvhTriangleLevels
};

/// A tree over the world-space boxes of instances. Leaves index BvhInstances in the order of `order`.
struct InstanceBvh {
    std::vector<kernels::BvhNode> nodes;
    std::vector<std::uint32_t> order;  ///< index of the box (instance) at each leaf position
    Bounds bounds;
    int levels = 0;  ///< <= kernels::kBvhInstanceLevels
};

/// `opaque` and `masked` are geometry 0 and 1 of the hits. Omitted, since no ray can hit them: triangles without area,
/// with a corner that is not finite or beyond 1.8e18 (as in Embree, to avoid overflow of squares), or with an index out
/// of range. Errors: outOfMemory, invalidArgument (more than 2^31 triangles, or no Embree on this processor).
Result<TriangleBvh> buildTriangleBvh(const Context& context, const TriangleSoup& opaque, const TriangleSoup& masked);

/// Boxes that are not finite or inverted are omitted. Errors as above, and invalidArgument if
/// kernels::kBvhInstanceLevels is too small (about 8^9 boxes).
Result<InstanceBvh> buildInstanceBvh(const Context& context, std::span<const Bounds> boxes);

/// Refits to moved triangles or boxes: same counts and indices, same topology, new planes. Omitted triangles stay
/// omitted; degenerate ones are no longer hit. Costs one pass over the nodes. After large motion the tree is slower to
/// trace, but still correct.
void refit(TriangleBvh& bvh, const TriangleSoup& opaque, const TriangleSoup& masked);
void refit(InstanceBvh& bvh, std::span<const Bounds> boxes);

/// All trees of a scene in two arrays, as the traversal reads them.
struct BvhArrays {
    std::vector<kernels::BvhNode> nodes;
    std::vector<kernels::BvhTriangle> triangles;

    /// Appends a tree and returns its root; kernels::kBvhNone for an empty one.
    std::uint32_t append(const TriangleBvh& bvh);
    /// `firstInstance`: position of bvh.order in the array of BvhInstances.
    std::uint32_t append(const InstanceBvh& bvh, std::uint32_t firstInstance = 0);
};

/// A placed group. `toWorld` must be invertible.
kernels::BvhInstance makeBvhInstance(const glm::mat4& toWorld, std::uint32_t root, int number);

/// World-space box of a placed box, rounded outwards.
Bounds placedBounds(const Bounds& bounds, const glm::mat4& toWorld);

}  // namespace probegi
