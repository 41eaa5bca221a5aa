// Triangles by the library's own BVH: any Vulkan device.
#ifndef PROBEGI_TRACER_BVH_GLSL
#define PROBEGI_TRACER_BVH_GLSL

#include "tracer.glsl"

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
    return BvhNodes(sceneConstants.bvh.nodes).at[index];
}
BvhTriangle bvhTriangle(uint index) {
    return BvhTriangles(sceneConstants.bvh.triangles).at[index];
}
BvhInstance bvhInstance(uint index) {
    return BvhInstances(sceneConstants.bvh.instances).at[index];
}
bool bvhAlphaPasses(int instance, int primitive, vec2 barycentric) {
    return alphaPasses(instance, kGeometryMasked, primitive, barycentric);
}

#include "kernels/trace/bvh_traverse.h"

Hit closestHit(Ray ray) {
    const BvhHit hit = bvhClosestHit(ray.origin, max(ray.near, 0.0), ray.direction, ray.far,
                                     sceneConstants.bvh.worldRoot, sceneConstants.bvh.instancesRoot);
    return Hit(hit.distance, hit.primitive, hit.geometry, hit.instance, hit.barycentric);
}

bool occluded(Ray ray) {
    return bvhOccluded(ray.origin, max(ray.near, 0.0), ray.direction, ray.far, sceneConstants.bvh.worldRoot,
                       sceneConstants.bvh.instancesRoot);
}

#endif
