// Closest hit and occlusion over two levels of the wide BVH: triangles of the world itself, and instances of groups of
// triangles below a tree of boxes. The traversal of Ylitie, Karras, Laine 2017, section 4, without its warp-level
// operations: the stack holds the remaining hit children of a node, one entry per level, and children are visited in
// the order of the ray's octant, without sorting. (On Sponza, random rays: 8.7 nodes and 6.8 triangles per ray; sorted
// by distance, with a stack entry per child, 6.7 and 3.9.) No recursion; the builder guarantees that the fixed-size
// stack suffices.
//
// Define before including this (in KERNELS_BEGIN .. KERNELS_END, after bvh_scene.h):
//     BvhNode bvhNode(uint index);
//     BvhTriangle bvhTriangle(uint index);
//     BvhInstance bvhInstance(uint index);
//     // Whether a masked triangle is solid at a point of it. `instance` is BvhInstance::number, or -1.
//     bool bvhAlphaPasses(int instance, int primitive, vec2 barycentric);
// All trees share one array of nodes and one of triangles. In C++, only one source file of a program may include this.
#ifndef PROBEGI_KERNELS_BVH_TRAVERSE_H
#define PROBEGI_KERNELS_BVH_TRAVERSE_H

#include "kernels/trace/bvh_scene.h"

KERNELS_BEGIN

struct BvhHit {
    float distance;    // in lengths of the ray's direction; kBvhMissDistance where nothing was hit
    int primitive;     // -1: nothing was hit
    int geometry;      // 0: opaque, 1: masked
    int instance;      // -1: the world
    vec2 barycentric;  // weights of the second and third corner
};

// Entry of either level: a tree's root as a group with one hit child.
KERNEL_FN uvec2 bvhRootGroup(uint root) {
    return uvec2(root, 0x80000000u);
}

// The node that a group visits next: that of the highest bit.
KERNEL_FN uint bvhNextChild(INOUT(uvec2) group, uint octant) {
    const uint bit = uint(findMSB(group.y));
    const uint slot = (bit - 24u) ^ octant;
    group.y &= ~(1u << bit);
    return group.x + uint(bitCount(group.y & ((1u << slot) - 1u)));
}

// Tests the triangles of `bits`, counted from `first`; true if the traversal is finished.
KERNEL_FN bool bvhLeafTriangles(BvhRay ray, float near, uint first, uint bits, int instance, bool any,
                                INOUT(BvhHit) hit) {
    while (bits != 0u) {
        const BvhTriangle triangle = bvhTriangle(first + uint(findLSB(bits)));
        bits &= bits - 1u;
        TriangleHit candidate;
        if (!intersectTriangle(ray, triangle.corner0, triangle.corner1, triangle.corner2, near, hit.distance,
                               candidate))
            continue;
        if (triangle.geometry != 0 && !bvhAlphaPasses(instance, triangle.primitive, candidate.barycentric)) continue;
        hit.distance = candidate.distance;
        hit.primitive = triangle.primitive;
        hit.geometry = triangle.geometry;
        hit.instance = instance;
        hit.barycentric = candidate.barycentric;
        if (any) return true;
    }
    return false;
}

// `worldRoot`: of the triangles in world space; `instancesRoot`: of the tree over instances; either may be kBvhNone.
// `any`: any hit will do. The world's triangles, usually the majority, come first: their hits cull the instances behind
// them.
KERNEL_FN BvhHit bvhTraverse(vec3 origin, float near, vec3 direction, float far, uint worldRoot, uint instancesRoot,
                             bool any) {
    BvhHit hit;
    hit.distance = far;
    hit.primitive = -1;
    hit.geometry = -1;
    hit.instance = -1;
    hit.barycentric = vec2(0.0f, 0.0f);

    // A group is a base and bits: nodes (bits 24..31 hit, 0..7 which slots hold inner nodes), or, without bits 24..31,
    // leaves. Stack entries from `floorSize` up belong to the current bottom level.
    uvec2 stack[kBvhStackSize];
    int size = 0;
    int floorSize = 0;
    bool inTriangles = worldRoot != kBvhNone;
    uvec2 group = bvhRootGroup(inTriangles ? worldRoot : instancesRoot);
    bool going = bvhRayIsValid(origin, near, direction, far) && (inTriangles || instancesRoot != kBvhNone);
    if (inTriangles && instancesRoot != kBvhNone) {
        stack[0] = bvhRootGroup(instancesRoot);
        size = 1;
        floorSize = 1;
    }
    BvhRay ray = makeBvhRay(origin, direction);
    int instance = -1;

    while (going) {
        uint first = group.x;
        uint leaves = group.y;
        if (group.y > kBvhLeafBits) {
            const uint child = bvhNextChild(group, ray.octant);
            if (group.y > kBvhLeafBits) stack[size++] = group;
            const BvhNode node = bvhNode(child);
            const uint hits = bvhNodeHits(node, ray, near, hit.distance);
            group = uvec2(node.children, (hits & ~kBvhLeafBits) | (node.exponents >> 24u));
            first = node.leaves;
            leaves = hits & kBvhLeafBits;
        } else {
            group.y = 0u;
        }
        if (inTriangles) {
            if (bvhLeafTriangles(ray, near, first, leaves, instance, any, hit)) break;
        } else if (leaves != 0u) {
            if (group.y > kBvhLeafBits) stack[size++] = group;
            const BvhInstance placed = bvhInstance(first + uint(findLSB(leaves)));
            leaves &= leaves - 1u;
            if (leaves != 0u) stack[size++] = uvec2(first, leaves);
            floorSize = size;
            inTriangles = true;
            instance = placed.number;
            ray = makeBvhRay(bvhInstancePoint(placed, origin), bvhInstanceVector(placed, direction));
            group = bvhRootGroup(placed.root);
        }
        if (group.y <= kBvhLeafBits) {
            if (size == 0) break;
            if (inTriangles && size == floorSize) {
                inTriangles = false;
                ray = makeBvhRay(origin, direction);
            }
            group = stack[--size];
        }
    }
    if (hit.primitive < 0) hit.distance = kBvhMissDistance;
    return hit;
}

KERNEL_FN BvhHit bvhClosestHit(vec3 origin, float near, vec3 direction, float far, uint worldRoot, uint instancesRoot) {
    return bvhTraverse(origin, near, direction, far, worldRoot, instancesRoot, false);
}

KERNEL_FN bool bvhOccluded(vec3 origin, float near, vec3 direction, float far, uint worldRoot, uint instancesRoot) {
    return bvhTraverse(origin, near, direction, far, worldRoot, instancesRoot, true).primitive >= 0;
}

KERNELS_END

#endif
