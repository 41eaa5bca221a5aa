#include "lane.h"

#include "exact_hit_access.h"

#include "kernels/sdf/exact_hit.h"

// Rays nearly along x through the cubes, which neither begin nor end where rounding would decide.
void evaluate(INOUT(Lane) lane) {
    const float x = 0.1f * float(takeIndex(lane, 60)) - 1.53f;
    const float y = takeBetween(lane, -0.3f, 0.3f);
    const float z = takeBetween(lane, -0.3f, 0.3f);
    const float slope = takeBetween(lane, -0.01f, 0.01f);
    const vec3 origin = vec3(x, y, z);
    const vec3 direction = normalize(vec3(takeIndex(lane, 2) == 0 ? 1.0f : -1.0f, slope, -slope));
    const float far = takeIndex(lane, 4) == 0 ? 1e30f : 0.1f * float(takeIndex(lane, 30)) + 0.06f;
    bool within = false;
    const SdfFound found = sdfClosestHit(origin, 0.0f, direction, far, kCubes, within);
    giveBits(lane, uint(found.solid));
    give(lane, found.solid < 0 ? 0.0f : found.distance, 1e-5f);
    giveBits(lane, within ? 1u : 0u);
    giveBits(lane, sdfIsBlocked(origin, 0.0f, direction, far, kCubes) ? 1u : 0u);
    give(lane, sdfWayOut(origin, 0.0f, direction, kCubes).distance, 1e-5f);
}
