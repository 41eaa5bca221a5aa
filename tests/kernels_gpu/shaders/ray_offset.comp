#include "lane.h"

#include "kernels/trace/ray_offset.h"

// The range is a power of two, so that the random position is exact.
void evaluate(INOUT(Lane) lane) {
    const vec3 position = takeVector(lane, -1024.0f, 1024.0f);
    const vec3 normal = takeDirection(lane);
    const float magnitude = takeBetween(lane, 1.0f, 2000.0f);
    give(lane, rayOffset(position, magnitude), 1e-8f);
    giveVec3(lane, offsetOrigin(position, normal, magnitude), 3e-7f);
    give(lane, shadowRayEnd(takeBetween(lane, 0.0f, 50.0f)), 1e-6f);
}
