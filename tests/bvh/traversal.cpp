#include "bvh/traversal.h"

namespace probegi::kernels {
namespace {

const test::TracedWorld* g_world = nullptr;

BvhNode bvhNode(uint index) {
    ++g_world->nodeVisits;
    return g_world->arrays.nodes.at(index);
}

BvhTriangle bvhTriangle(uint index) {
    ++g_world->triangleTests;
    return g_world->arrays.triangles.at(index);
}

BvhInstance bvhInstance(uint index) {
    return g_world->instances.at(index);
}

bool bvhAlphaPasses(int instance, int primitive, vec2 barycentric) {
    return g_world->alphaPasses(instance, primitive, barycentric);
}

}  // namespace
}  // namespace probegi::kernels

#include "kernels/trace/bvh_traverse.h"

namespace probegi::test {

Hit closestHit(const TracedWorld& world, const Ray& ray) {
    kernels::g_world = &world;
    const kernels::BvhHit hit =
        kernels::bvhClosestHit(ray.origin, ray.near, ray.direction, ray.far, world.worldRoot, world.instancesRoot);
    return {hit.distance, hit.primitive, hit.geometry, hit.instance, hit.barycentric};
}

bool occluded(const TracedWorld& world, const Ray& ray) {
    kernels::g_world = &world;
    return kernels::bvhOccluded(ray.origin, ray.near, ray.direction, ray.far, world.worldRoot, world.instancesRoot);
}

}  // namespace probegi::test
