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
    giveBits(lane, uint(lowestUsed(1.3f, 0.4f, 5) + 8 * highestUsed(1.3f, 0.4f, 5)));
}
