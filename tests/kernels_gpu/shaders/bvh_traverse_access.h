// A small scene for bvh_traverse.h: three triangles of the world below two inner nodes, the last one masked, and two
// instances of a fourth.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_BVH_TRAVERSE_ACCESS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_BVH_TRAVERSE_ACCESS_H

#include "kernels/trace/bvh_scene.h"

KERNELS_BEGIN

// All children have a box of about -8..8, so that every ray visits all of them.
KERNEL_FN BvhNode bvhNode(uint index) {
    BvhNode node;
    node.origin = vec3(-8.0f, -8.0f, -8.0f);
    node.exponents = 0x7b7b7bu | (index == 0u ? 0x81000000u : 0u);
    node.children = 1u;
    node.leaves = index == 2u ? 2u : (index == 4u ? 3u : 0u);
    // Nodes 0: inner in slots 0 and 7; 1: two triangles; 2: one; 3: two instances; 4: the group's triangle.
    node.meta = index == 0u
                    ? uvec2(kBvhInnerMeta, (kBvhInnerMeta + 7u) << 24u)
                    : (index == 1u ? uvec2(0x6000u, 0u) : (index == 3u ? uvec2(0x2100u, 0x20u) : uvec2(0x200000u, 0u)));
    node.lowerX = uvec2(0u, 0u);
    node.lowerY = uvec2(0u, 0u);
    node.lowerZ = uvec2(0u, 0u);
    node.upperX = uvec2(0xffffffffu, 0xffffffffu);
    node.upperY = uvec2(0xffffffffu, 0xffffffffu);
    node.upperZ = uvec2(0xffffffffu, 0xffffffffu);
    return node;
}

KERNEL_FN BvhTriangle bvhTriangle(uint index) {
    const float height = 0.713f * float(index) - 1.0f;
    BvhTriangle triangle;
    triangle.corner0 = vec3(-3.17f, height, -2.93f);
    triangle.corner1 = vec3(4.41f, height + 0.31f, -2.53f);
    triangle.corner2 = vec3(-0.37f, height - 0.23f, 4.29f);
    triangle.primitive = 10 + int(index);
    triangle.geometry = index == 2u ? 1 : 0;
    triangle.unused = 0;
    return triangle;
}

KERNEL_FN BvhInstance bvhInstance(uint index) {
    BvhInstance placed;
    placed.row0 = vec4(0.0f, 2.0f, 0.0f, -0.13f);
    placed.row1 = vec4(0.0f, 0.0f, 1.0f, 2.0f * float(index));
    placed.row2 = vec4(1.5f, 0.0f, 0.0f, 0.0f);
    placed.root = 4u;
    placed.number = 20 + int(index);
    placed.unused0 = 0;
    placed.unused1 = 0;
    return placed;
}

KERNEL_FN bool bvhAlphaPasses(int instance, int primitive, vec2 barycentric) {
    return instance < 0 && primitive == 12 && barycentric.x > 0.377f;
}

KERNELS_END

#endif
