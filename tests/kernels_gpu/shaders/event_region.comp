#include "lane.h"

#include "kernels/blend/event_region.h"

void evaluate(INOUT(Lane) lane) {
    EventLimit limit = noEventLimit();
    const vec3 position = takeVector(lane, -1.0f, 1.0f);
    for (int i = 0; i < 2; ++i) {
        EventRegion region;
        region.lower = takeVector(lane, -1.0f, 0.2f);
        region.upper = takeVector(lane, -0.2f, 1.0f);
        region.irradianceKept = takeBetween(lane, 0.0f, 0.99f);
        region.visibilityKept = i == 0 ? 1.0f : takeBetween(lane, 0.0f, 0.99f);
        giveBits(lane, isInRegion(region, position) ? 1u : 0u);
        addEventRegion(limit, region, position);
    }
    give(lane, limit.irradianceKept, 0.0f);
    give(lane, limit.visibilityKept, 0.0f);
    give(lane, limitedWindow(takeBetween(lane, 1.0f, 200.0f), limit.irradianceKept), 1e-5f);
    give(lane, limitedKept(takeBetween(lane, 0.0f, 1.0f), limit.visibilityKept), 1e-5f);
    give(lane, windowOfHysteresis(takeBetween(lane, 0.0f, 0.99f)), 1e-5f);
    giveBits(lane, uint(kMostEventRegions));
}
