// A node of the wide BVH: the boxes of up to eight children, quantised (Ylitie, Karras, Laine 2017, "Efficient
// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 3), and a ray's test against all eight.
#ifndef PROBEGI_KERNELS_BVH_NODE_H
#define PROBEGI_KERNELS_BVH_NODE_H

#include "kernels/language.h"

KERNELS_BEGIN

// 80 bytes, aligned to 16 on a GPU. A plane at q is `origin + q 2^e`, with an exponent e for each axis. Eight children
// have a byte each in the pairs of words, child 0 in the lowest byte of x, child 7 in the highest of y.
struct BvhNode {
    vec3 origin;     // lower corner of the node's box
    uint exponents;  // bytes 0..2: e + 127 for x, y, z; byte 3: a bit for each slot that holds an inner node
    uint children;   // the first inner child; the others follow in slot order
    uint leaves;     // the first triangle (in a top level: instance) of the leaves; the others follow
    uvec2 meta;      // contents of each slot, see below
    uvec2 lowerX;
    uvec2 lowerY;
    uvec2 lowerZ;
    uvec2 upperX;
    uvec2 upperY;
    uvec2 upperZ;
};

// meta (the paper's section 3.1): the low five bits are the position of the child's first bit in the hit word, the high
// three bits are the bits to set there. An inner node in slot s: 1 at 24 + s. A leaf of n <= 3 triangles: n ones at the
// number of its first triangle, counted from `leaves`, 0..23. An empty slot: 0.
KERNEL_CONST uint kBvhInnerMeta = 0x38u;  // (1 << 5) + 24, plus s
KERNEL_CONST uint kBvhLeafBits = 0x00ffffffu;
KERNEL_CONST uint kBvhLeafSize = 3u;

// A ray with what every node test needs. Directions need not be unit; distances are multiples of their length.
struct BvhRay {
    vec3 origin;
    vec3 inverse;  // 1 / direction, finite
    vec3 shear;    // for triangle_hit.h: the direction's two smaller components over its largest, and 1 / the largest
    int axis;      // the largest component of the direction
    uint octant;   // bit a is set if the direction's component a is not negative
};

// v with its components rotated so that `axis` comes last.
KERNEL_FN vec3 bvhRotate(vec3 v, int axis) {
    return axis == 0 ? vec3(v.y, v.z, v.x) : (axis == 1 ? vec3(v.z, v.x, v.y) : v);
}

// Neither infinite nor NaN. Tested on the bits, since shader compilers may assume that such values do not occur.
KERNEL_FN bool bvhIsFinite(float x) {
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}

// Whether the ray can hit anything: all finite, a non-zero direction, a non-empty interval. `far` may be infinite.
KERNEL_FN bool bvhRayIsValid(vec3 origin, float near, vec3 direction, float far) {
    const float largest = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
    return bvhIsFinite(origin.x) && bvhIsFinite(origin.y) && bvhIsFinite(origin.z) && bvhIsFinite(direction.x) &&
           bvhIsFinite(direction.y) && bvhIsFinite(direction.z) && bvhIsFinite(near) && largest > 0.0f && near <= far;
}

// Reciprocal of a direction's component; one that is negligible beside the largest counts as tiny, so that no box test
// multiplies 0 by infinity.
KERNEL_FN float bvhInverse(float component, float largest) {
    const float tiny = 1e-18f * largest;
    return 1.0f / (abs(component) > tiny ? component : (component < 0.0f ? -tiny : tiny));
}

// The ray must be valid.
KERNEL_FN BvhRay makeBvhRay(vec3 origin, vec3 direction) {
    const vec3 size = abs(direction);
    const float largest = max(size.x, max(size.y, size.z));
    BvhRay ray;
    ray.origin = origin;
    ray.inverse =
        vec3(bvhInverse(direction.x, largest), bvhInverse(direction.y, largest), bvhInverse(direction.z, largest));
    ray.axis = size.x == largest ? 0 : (size.y == largest ? 1 : 2);
    const vec3 rotated = bvhRotate(direction, ray.axis);
    ray.shear = vec3(rotated.x / rotated.z, rotated.y / rotated.z, 1.0f / rotated.z);
    ray.octant = (direction.x < 0.0f ? 0u : 1u) | (direction.y < 0.0f ? 0u : 2u) | (direction.z < 0.0f ? 0u : 4u);
    return ray;
}

// Box tests must be conservative. Ize 2013 ("Robust BVH Ray Traversal") widens the far distance by a relative 2 ulp,
// which suffices if plane minus origin is a single rounding. A quantised plane's distance is a sum,
// (node's origin - ray's origin) / direction + q 2^e / direction, that may cancel, so its error is relative to its
// terms. Each of the few roundings (a GPU's division has 2.5 ulp) is at most 2^-24 of them; this is 16 times that.
KERNEL_CONST float kBvhPadding = 9.5367432e-7f;

// Hit bits of four children, one per byte. `scale`: distance of a quantisation step; `enter`, `leave`: distances of
// plane 0.
KERNEL_FN uint bvhFourChildren(uint meta, uint octant, uvec3 nearPlanes, uvec3 farPlanes, vec3 scale, vec3 enter,
                               vec3 leave, float near, float far) {
    uint hits = 0u;
    for (uint shift = 0u; shift < 32u; shift += 8u) {
        const float enterX = float((nearPlanes.x >> shift) & 255u) * scale.x + enter.x;
        const float enterY = float((nearPlanes.y >> shift) & 255u) * scale.y + enter.y;
        const float enterZ = float((nearPlanes.z >> shift) & 255u) * scale.z + enter.z;
        const float leaveX = float((farPlanes.x >> shift) & 255u) * scale.x + leave.x;
        const float leaveY = float((farPlanes.y >> shift) & 255u) * scale.y + leave.y;
        const float leaveZ = float((farPlanes.z >> shift) & 255u) * scale.z + leave.z;
        const bool hit = max(max(enterX, enterY), max(enterZ, near)) <= min(min(leaveX, leaveY), min(leaveZ, far));
        const uint what = (meta >> shift) & 255u;
        const uint first = what & 31u;
        const uint bit = first ^ (first >= 24u ? octant : 0u);
        hits |= hit ? (what >> 5u) << bit : 0u;
    }
    return hits;
}

// Which children the ray hits between near and far, in one word: bits 24..31 are inner nodes, the first to visit
// highest: slot s is bit 24 + (s ^ octant), since the builder puts the child towards -x -y -z in slot 0 (the paper's
// section 3.2). Bits 0..23 are triangles, counted from `leaves`.
KERNEL_FN uint bvhNodeHits(BvhNode node, BvhRay ray, float near, float far) {
    const vec3 scale = ray.inverse * vec3(uintBitsToFloat((node.exponents & 255u) << 23u),
                                          uintBitsToFloat((node.exponents & 0xff00u) << 15u),
                                          uintBitsToFloat((node.exponents & 0xff0000u) << 7u));
    const vec3 start = (node.origin - ray.origin) * ray.inverse;
    const vec3 padding = (abs(start) + abs(scale) * 255.0f) * kBvhPadding;
    const vec3 enter = start - padding;
    const vec3 leave = start + padding;
    const bool x = (ray.octant & 1u) != 0u;
    const bool y = (ray.octant & 2u) != 0u;
    const bool z = (ray.octant & 4u) != 0u;
    const uvec2 nearX = x ? node.lowerX : node.upperX;
    const uvec2 nearY = y ? node.lowerY : node.upperY;
    const uvec2 nearZ = z ? node.lowerZ : node.upperZ;
    const uvec2 farX = x ? node.upperX : node.lowerX;
    const uvec2 farY = y ? node.upperY : node.lowerY;
    const uvec2 farZ = z ? node.upperZ : node.lowerZ;
    return bvhFourChildren(node.meta.x, ray.octant, uvec3(nearX.x, nearY.x, nearZ.x), uvec3(farX.x, farY.x, farZ.x),
                           scale, enter, leave, near, far) |
           bvhFourChildren(node.meta.y, ray.octant, uvec3(nearX.y, nearY.y, nearZ.y), uvec3(farX.y, farY.y, farZ.y),
                           scale, enter, leave, near, far);
}

KERNELS_END

#endif
