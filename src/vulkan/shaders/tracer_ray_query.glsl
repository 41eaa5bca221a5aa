// Triangles by VK_KHR_ray_query.
#ifndef PROBEGI_TRACER_RAY_QUERY_GLSL
#define PROBEGI_TRACER_RAY_QUERY_GLSL

#extension GL_EXT_ray_query : require

#include "tracer.glsl"

#include "kernels/trace/bvh_node.h"

layout(set = 1, binding = 1) uniform accelerationStructureEXT sceneStructure;

// The placement of an intersection; -1: the world (src/vulkan/tracers/ray_query_scene_tracer.cpp).
#define RAY_QUERY_INSTANCE(query, committed) (rayQueryGetIntersectionInstanceCustomIndexEXT(query, committed) - 1)

// Candidates are points of masked triangles: opaque ones are committed without a word.
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
    rayQueryInitializeEXT(query, sceneStructure, gl_RayFlagsNoneEXT, 0xffu, ray.origin, near, ray.direction, ray.far);
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
    rayQueryInitializeEXT(query, sceneStructure, gl_RayFlagsTerminateOnFirstHitEXT, 0xffu, ray.origin, near,
                          ray.direction, ray.far);
    RAY_QUERY_RUN(query)
    return rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
}

#endif
