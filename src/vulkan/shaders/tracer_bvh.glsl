// Triangles by the library's own BVH, for any Vulkan device. Its block (BvhSceneTracer::block) has the addresses of
// nodes, triangles and instances, and the roots of the world and of the instances.
#ifndef PROBEGI_TRACER_BVH_GLSL
#define PROBEGI_TRACER_BVH_GLSL

#include "triangles.glsl"

#include "kernels/trace/bvh_scene.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer BvhNodes {
    BvhNode at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer BvhTriangles {
    BvhTriangle at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer BvhInstances {
    BvhInstance at[];
};

BvhNode bvhNode(uint index) {
    return BvhNodes(sceneConstants.tracer.addresses[0]).at[index];
}
BvhTriangle bvhTriangle(uint index) {
    return BvhTriangles(sceneConstants.tracer.addresses[1]).at[index];
}
BvhInstance bvhInstance(uint index) {
    return BvhInstances(sceneConstants.tracer.addresses[2]).at[index];
}
bool bvhAlphaPasses(int instance, int primitive, vec2 barycentric) {
    return alphaPasses(instance, kGeometryMasked, primitive, barycentric);
}

#include "kernels/trace/bvh_traverse.h"

Hit closestHit(Ray ray) {
    const BvhHit hit = bvhClosestHit(ray.origin, max(ray.near, 0.0), ray.direction, ray.far,
                                     sceneConstants.tracer.numbers[0], sceneConstants.tracer.numbers[1]);
    return Hit(hit.distance, hit.primitive, hit.geometry, hit.instance, hit.barycentric);
}

bool occluded(Ray ray) {
    return bvhOccluded(ray.origin, max(ray.near, 0.0), ray.direction, ray.far, sceneConstants.tracer.numbers[0],
                       sceneConstants.tracer.numbers[1]);
}

#endif
