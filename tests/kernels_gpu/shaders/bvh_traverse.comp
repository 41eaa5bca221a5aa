#include "lane.h"

#include "bvh_traverse_access.h"

#include "kernels/trace/bvh_traverse.h"

void giveHit(INOUT(Lane) lane, BvhHit hit) {
    give(lane, hit.distance, 1e-4f);
    giveBits(lane, uint(hit.primitive));
    giveBits(lane, uint(hit.geometry));
    giveBits(lane, uint(hit.instance));
    giveVec2(lane, hit.barycentric, 1e-4f);
}

void evaluate(INOUT(Lane) lane) {
    const vec3 origin = takeVector(lane, -3.0f, 3.0f);
    const vec3 direction = takeDirection(lane);
    const float far = takeBetween(lane, 0.0f, 6.0f);
    giveHit(lane, bvhClosestHit(origin, 0.0f, direction, 1e30f, 0u, 3u));
    giveHit(lane, bvhClosestHit(origin, 0.0f, direction, 1e30f, 0u, kBvhNone));
    giveHit(lane, bvhClosestHit(origin, 0.0f, direction, 1e30f, kBvhNone, 3u));
    giveHit(lane, bvhClosestHit(origin, 0.0f, direction, 1e30f, kBvhNone, kBvhNone));
    giveHit(lane, bvhTraverse(origin, 0.5f, direction, far, 0u, 3u, true));
    giveBits(lane, bvhOccluded(origin, 0.0f, direction, far, 0u, 3u) ? 1u : 0u);
    // An invalid ray must terminate without a hit.
    giveHit(lane, bvhClosestHit(origin, 0.0f, vec3(uintBitsToFloat(0x7fc00000u)), 1e30f, 0u, 3u));

    uvec2 group = bvhRootGroup(5u);
    giveBits(lane, bvhNextChild(group, uint(takeIndex(lane, 8))));
    giveBits(lane, group.y);
    BvhHit hit;
    hit.distance = 1e30f;
    hit.primitive = -1;
    hit.geometry = -1;
    hit.instance = -1;
    hit.barycentric = vec2(0.0f, 0.0f);
    giveBits(lane, bvhLeafTriangles(makeBvhRay(origin, direction), 0.0f, 0u, 3u, 7, false, hit) ? 1u : 0u);
    giveHit(lane, hit);
}
