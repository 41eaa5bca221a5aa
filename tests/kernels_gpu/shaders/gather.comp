#include "lane.h"

#include "lookup_access.h"

#include "kernels/lookup/gather.h"

void evaluate(INOUT(Lane) lane) {
    const Access access = accessTo(kRulesMeasured, 0, 0.0f);
    CageWeights w;
    for (int corner = 0; corner < 8; ++corner) {
        w.slot[corner] = 10 * corner + takeIndex(lane, 10);
        w.weight[corner] = takeUnit(lane);
    }
    for (int k = 0; k < 4; ++k) w.pair[k] = takeUnit(lane);
    w.axis = takeIndex(lane, 3);
    w.up = takeIndex(lane, 2);
    w.step = takeIndex(lane, 100);
    const vec3 normal = takeDirection(lane);
    giveVec3(lane, storedRoot(access, w.slot[3], normal), 2e-6f);
    const CageLight light = gatherLight(access, w, normal);
    giveVec3(lane, light.root, 2e-5f);
    giveVec3(lane, light.rise, 2e-5f);
    for (int corner = 0; corner < 8; ++corner) give(lane, pairOfCorner(w, corner), 0.0f);
}
