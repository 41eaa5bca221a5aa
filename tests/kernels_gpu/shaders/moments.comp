#include "lane.h"

#include "lookup_access.h"
#include "some_cage.h"

#include "kernels/guards/moments.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const Access access = accessTo(takeIndex(lane, 2), 1, 0.0f);
    const vec3 fromProbe = takeVector(lane, -3.0f, 3.0f);
    const float mean = takeUnit(lane);
    const float variance = takeUnit(lane);
    const float distance = takeBetween(lane, 0.0f, 2.0f);
    give(lane, neighbourVisibility(mean, mean * mean + 0.01f + variance, distance), 2e-4f);
    const Cage cage = takeCage(lane, v);
    give(lane, momentsPoint(access, v, cage, cageSlots(v, cage.base)).scale, 0.0f);
    give(lane, momentsSeen(access, v, 5, 0, fromProbe, noGuardPoint()), 5e-4f);
    give(lane, momentsBetween(access, v, 5, 3, axisPoint(access, v, 1, true), distance, fromProbe), 5e-4f);
    giveVec3(lane, momentsBegin(access, v, cage), 0.0f);
    // The result is discontinuous at the farthest distance.
    if (abs(length(fromProbe) * v.inverseMaxDistance - 1.0f) < 1e-3f)
        give(lane, 0.0f, 0.0f);
    else
        give(lane, momentsFar(access, v, 5, fromProbe, vec3(0.0f)), 5e-4f);
}
