#include "lane.h"

#include "some_solid.h"

void evaluate(INOUT(Lane) lane) {
    const SdfSolid solid = takeSolid(lane);
    give(lane, sdfRounding(solid), 0.0f);
    SdfBlocker blocker;
    blocker.solid = solid;
    blocker.reach = vec3(1.0f, 2.0f, 3.0f);
    giveVec3(lane, blocker.solid.halfSize + blocker.reach, 1e-6f);
}
