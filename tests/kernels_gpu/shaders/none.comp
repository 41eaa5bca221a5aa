#include "lane.h"

#include "lookup_access.h"
#include "some_cage.h"

#include "kernels/guards/none.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const Access access = accessTo(takeIndex(lane, 2), 0, 0.0f);
    const vec3 fromProbe = takeVector(lane, -3.0f, 3.0f);
    const Cage cage = takeCage(lane, v);
    give(lane, nonePoint(access, v, cage, cageSlots(v, cage.base)).scale, 0.0f);
    give(lane, noneSeen(access, v, 3, 0, fromProbe, noGuardPoint()), 0.0f);
    give(lane, noneBetween(access, v, 3, 1, fromProbe, 1.0f, fromProbe), 0.0f);
    giveVec3(lane, noneBegin(access, v, cage), 0.0f);
    give(lane, noneFar(access, v, 3, fromProbe, fromProbe), 0.0f);
}
