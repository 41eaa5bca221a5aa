#include "lane.h"

#include "some_volume.h"

#include "lookup_access.h"

#include "kernels/lookup/used_probes.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const vec3 point = v.origin + takeVector(lane, -2.0f, 6.0f);
    const vec3 normal = takeDirection(lane);
    const int rules = takeIndex(lane, 2);
    // Points on the seam of two cells may round apart.
    const UsedProbes used = usedProbes(v, point, normal, 0.3f, rules);
    giveCell(lane, used.lowest);
    giveCell(lane, used.highest);
    giveVec3(lane, moverReach(v, 0.3f, rules), 1e-6f);
    const vec3 upper = point + takeVector(lane, 0.0f, 2.0f);
    const Box box = boxInVolume(v, point, upper);
    giveVec3(lane, box.lower, 5e-5f);
    giveVec3(lane, box.upper, 5e-5f);
    const ivec3 cell = takeCell(lane, v);
    giveBits(lane, isNearBox(v, cell, box, floor(moverReach(v, 0.3f, rules)) + 0.123f) ? 1u : 0u);
    giveBits(lane, holdsPoint(box, v.origin) ? 1u : 0u);
    giveBits(lane, uint(lowestUsed(1.3f, 0.4f, 5) + 8 * highestUsed(1.3f, 0.4f, 5)));
}
