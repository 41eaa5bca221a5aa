// Triangles by VK_KHR_ray_query. Its block has the address of the top level (RayQuerySceneTracer::block).
#ifndef PROBEGI_TRACER_RAY_QUERY_GLSL
#define PROBEGI_TRACER_RAY_QUERY_GLSL

#extension GL_EXT_ray_query : require

#include "triangles.glsl"

#include "kernels/trace/bvh_node.h"

#define RAY_QUERY_SCENE accelerationStructureEXT(sceneConstants.tracer.addresses[0])

// Placement of an intersection; -1: the world (src/vulkan/tracers/ray_query_scene_tracer.cpp).
#define RAY_QUERY_INSTANCE(query, committed) (rayQueryGetIntersectionInstanceCustomIndexEXT(query, committed) - 1)

// Only masked triangles come up as candidates: opaque ones are committed automatically.
#define RAY_QUERY_RUN(query)                                                                                     \
    while (rayQueryProceedEXT(query)) {                                                                          \
        if (alphaPasses(RAY_QUERY_INSTANCE(query, false), rayQueryGetIntersectionGeometryIndexEXT(query, false), \
                        rayQueryGetIntersectionPrimitiveIndexEXT(query, false),                                  \
                        rayQueryGetIntersectionBarycentricsEXT(query, false)))                                   \
            rayQueryConfirmIntersectionEXT(query);                                                               \
    }

Hit closestHit(Ray ray) {
    Hit hit = Hit(kNoHitDistance, -1, -1, -1, vec2(0.0));
    const float near = max(ray.near, 0.0);
    if (!bvhRayIsValid(ray.origin, near, ray.direction, ray.far)) return hit;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, RAY_QUERY_SCENE, gl_RayFlagsNoneEXT, 0xffu, ray.origin, near, ray.direction, ray.far);
    RAY_QUERY_RUN(query)
    if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionTriangleEXT) return hit;
    hit.distance = rayQueryGetIntersectionTEXT(query, true);
    hit.primitive = rayQueryGetIntersectionPrimitiveIndexEXT(query, true);
    hit.geometry = rayQueryGetIntersectionGeometryIndexEXT(query, true);
    hit.instance = RAY_QUERY_INSTANCE(query, true);
    hit.barycentric = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return hit;
}

bool occluded(Ray ray) {
    const float near = max(ray.near, 0.0);
    if (!bvhRayIsValid(ray.origin, near, ray.direction, ray.far)) return false;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, RAY_QUERY_SCENE, gl_RayFlagsTerminateOnFirstHitEXT, 0xffu, ray.origin, near,
                          ray.direction, ray.far);
    RAY_QUERY_RUN(query)
    return rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
}

#endif
