// The rest of the two-level BVH: triangles, instances, and the limits that builder and traversal share.
#ifndef PROBEGI_KERNELS_BVH_SCENE_H
#define PROBEGI_KERNELS_BVH_SCENE_H

#include "kernels/trace/triangle_hit.h"

KERNELS_BEGIN

// 48 bytes, aligned to 16 on a GPU.
struct BvhTriangle {
    vec3 corner0;
    int primitive;
    vec3 corner1;
    int geometry;  // 0: opaque, 1: masked
    vec3 corner2;
    int unused;
};

// 64 bytes. Maps the world to the group's space: x' = dot(row0.xyz, x - origin), and so on, where the group's origin in
// the world is (row0.w, row1.w, row2.w). It is subtracted first, to avoid cancellation far from the world's origin.
struct BvhInstance {
    vec4 row0;
    vec4 row1;
    vec4 row2;
    uint root;   // of the group's triangles
    int number;  // in BvhHit
    int unused0;
    int unused1;
};

KERNEL_CONST uint kBvhNone = 0xffffffffu;
KERNEL_CONST float kBvhMissDistance = 1e30f;

// Node levels in a tree over triangles and in one over instances. A node of level k has at most k - 1 stack entries
// below it; an instance in the last level of the upper tree adds one for its siblings in the leaf.
KERNEL_CONST int kBvhTriangleLevels = 24;
KERNEL_CONST int kBvhInstanceLevels = 9;
KERNEL_CONST int kBvhStackSize = kBvhTriangleLevels + kBvhInstanceLevels - 1;

KERNEL_FN vec3 bvhInstanceVector(BvhInstance placed, vec3 v) {
    return vec3(placed.row0.x * v.x + placed.row0.y * v.y + placed.row0.z * v.z,
                placed.row1.x * v.x + placed.row1.y * v.y + placed.row1.z * v.z,
                placed.row2.x * v.x + placed.row2.y * v.y + placed.row2.z * v.z);
}

KERNEL_FN vec3 bvhInstancePoint(BvhInstance placed, vec3 p) {
    return bvhInstanceVector(placed, p - vec3(placed.row0.w, placed.row1.w, placed.row2.w));
}

KERNELS_END

#endif
