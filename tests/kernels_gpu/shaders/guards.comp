#include "lane.h"

#include "lookup_access.h"
#include "some_cage.h"

#include "kernels/guards/guards.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const vec3 fromProbe = takeVector(lane, -1.0f, 1.0f);
    const Cage cage = takeCage(lane, v);
    for (int guard = 0; guard < 4; ++guard) {
        const Access access = accessTo(kRulesMeasured, guard, 0.0f);
        give(lane, guardSeen(access, v, 6, 3, fromProbe, noGuardPoint()), 5e-4f);
        give(lane, guardSeen(access, v, 6, 3, fromProbe, guardPoint(access, v, cage, cageSlots(v, cage.base))), 0.02f);
        give(lane, guardBetween(access, v, 6, 4, axisPoint(access, v, 2, false), 1.0f, fromProbe), 5e-4f);
        const vec3 begin = guardBegin(access, v, cage);
        give(lane, guardFar(access, v, 6, fromProbe, begin), guard == 3 ? 0.05f : 5e-4f);
    }
}
