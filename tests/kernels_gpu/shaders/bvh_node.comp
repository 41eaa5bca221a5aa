#include "lane.h"

#include "kernels/trace/bvh_node.h"

// Any bits make a node: planes may be swapped, slots empty. Exponents are limited so that sums round alike on both
// sides.
BvhNode takeNode(INOUT(Lane) lane) {
    BvhNode node;
    node.origin = takeVector(lane, -3.0f, 3.0f);
    const uint e = 118u + uint(takeIndex(lane, 6));
    node.exponents = e | ((e + 1u) << 8u) | (e << 16u) | 0xf0000000u;
    node.children = 0u;
    node.leaves = 0u;
    node.meta = uvec2(0x26622320u, (kBvhInnerMeta + 4u) * 0x01010101u + 0x03020100u);
    // The first four children are arbitrary, the last four are valid and wide.
    node.lowerX = uvec2(takeBits(lane), 0x120c0426u);
    node.lowerY = uvec2(takeBits(lane), 0x01020304u);
    node.lowerZ = uvec2(takeBits(lane), 0x10203040u);
    node.upperX = uvec2(takeBits(lane), 0x80e0f0a3u);
    node.upperY = uvec2(takeBits(lane), 0xfdfcfbfau);
    node.upperZ = uvec2(takeBits(lane), 0xf0e0d0c0u);
    return node;
}

void giveRay(INOUT(Lane) lane, BvhRay ray) {
    giveVec3(lane, ray.inverse, 1e-6f);
    giveVec3(lane, ray.shear, 1e-6f);
    giveBits(lane, uint(ray.axis));
    giveBits(lane, ray.octant);
}

void evaluate(INOUT(Lane) lane) {
    BvhNode node = takeNode(lane);
    const vec3 origin = takeVector(lane, -5.0f, 5.0f);
    const vec3 direction = takeDirection(lane);
    const float far = takeBetween(lane, 0.0f, 20.0f);
    const float anything = uintBitsToFloat(takeBits(lane));
    const BvhRay ray = makeBvhRay(origin, direction);
    giveRay(lane, ray);
    giveBits(lane, bvhNodeHits(node, ray, 0.0f, far));
    giveBits(lane, bvhNodeHits(node, ray, 1.25f, 1e30f));
    giveBits(lane, bvhFourChildren(node.meta.y, ray.octant, uvec3(0u), uvec3(0xffffffffu), vec3(0.01f), direction,
                                   vec3(0.5f), 0.0f, far));
    giveVec3(lane, bvhRotate(origin, takeIndex(lane, 3)), 1e-6f);
    giveBits(lane, bvhIsFinite(anything) ? 1u : 0u);
    giveBits(lane, bvhRayIsValid(origin, 0.0f, direction * anything, far) ? 1u : 0u);
    giveBits(lane, bvhRayIsValid(origin, anything, direction, far) ? 1u : 0u);
    giveBits(lane, bvhRayIsValid(origin, 0.0f, vec3(0.0f), far) ? 1u : 0u);
    give(lane, bvhInverse(direction.x, 1.0f), 1e-6f);
    give(lane, bvhInverse(0.0f, 1.0f), 1e-6f);
}
