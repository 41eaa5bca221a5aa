#include "lane.h"

#include "kernels/lookup/probe_neighbours.h"

void evaluate(INOUT(Lane) lane) {
    const float variance = takeUnit(lane);
    const float outside = takeUnit(lane);
    const vec3 toProbe = takeVector(lane, -3.0f, 3.0f);
    const vec3 normal = takeDirection(lane);
    const vec3 sum = takeVector(lane, 0.0f, 2.0f * kDoubtful);
    const vec3 neighbours = takeVector(lane, 0.0f, 20.0f);
    const float weightSum = takeBetween(lane, 0.0f, kDoubtful);

    give(lane, neighbourWeight(outside, toProbe, normal, 1.0f, 1.5f), 2e-6f);
    give(lane, neighbourWeight(outside, toProbe, normal, variance, 0.7f), 2e-6f);
    giveVec3(lane, completedByNeighbours(sum, weightSum, neighbours), 2e-5f);
}
