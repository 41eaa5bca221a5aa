#include "lane.h"

#include "lookup_access.h"
#include "some_volume.h"

#include "kernels/lookup/access.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const vec3 a = takeVector(lane, -3.0f, 3.0f);
    const int axis = takeIndex(lane, 3);
    give(lane, component(axis, a), 0.0f);
    giveBits(lane, uint(componentOf(axis, 3, 5, 7)));
    give(lane, noGuardPoint().scale + noGuardPoint().seen[5], 0.0f);
    giveBits(lane, uint(noGuardPoint().low + noGuardPoint().high));
    giveVec3(lane, axisDirection(v, axis, a.x > 0.0f), 1e-5f);
}
