#include "lane.h"

#include "kernels/lookup/surface_gradient.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 normal = takeDirection(lane);
    const float root = takeBetween(lane, 0.0f, 3.0f);
    const float rise = takeBetween(lane, -0.5f, 1.0f);
    const float pairWeight = takeBetween(lane, 0.01f, 1.0f);
    const float ahead = takeBetween(lane, -0.5f, 2.0f);
    const float onAxis = takeBetween(lane, 0.577f, 1.0f);
    const float trust = takeUnit(lane);

    giveBits(lane, uint(dominantAxis(normal)));
    give(lane, axisTrust(normal), 2e-5f);
    const float cells = cellsAhead(ahead, 1.5f, -onAxis);
    give(lane, cells, 1e-5f);
    give(lane, rootAtSurface(root, rise, pairWeight, cells, trust), 2e-5f);
    give(lane, rootAtSurface(root, rise, 0.0f, cells, trust), 0.0f);
}
