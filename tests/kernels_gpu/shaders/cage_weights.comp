#include "lane.h"

#include "lookup_access.h"
#include "some_cage.h"

#include "kernels/lookup/cage_weights.h"

void giveWeights(INOUT(Lane) lane, CageWeights w) {
    for (int corner = 0; corner < 8; ++corner) {
        giveBits(lane, uint(w.slot[corner]));
        give(lane, w.weight[corner], 1e-4f);
    }
    give(lane, w.weightSum, 2e-4f);
    give(lane, w.ahead, 2e-4f);
    for (int k = 0; k < 4; ++k) {
        giveBits(lane, uint(frontCorner(w.axis, w.up, k)));
        give(lane, w.pair[k], 1e-3f);
    }
    giveBits(lane, uint(w.step + 4096));
    give(lane, w.pairSum, 2e-3f);
    give(lane, w.cells, 1e-3f);
    give(lane, w.trust, 1e-3f);
    give(lane, irradianceAtSurface(w, 0.5f * w.weightSum, 0.1f * w.pairSum, 1.0f / w.weightSum, kRulesMeasured), 2e-3f);
}

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const Cage cage = takeCage(lane, v);
    const int rules = takeIndex(lane, 2);
    const int guard = takeIndex(lane, 2);
    const Access access = accessTo(rules, guard, 0.27f);
    CageWeights w = weighCage(access, v, cage);
    giveWeights(lane, w);
    weighProbes(access, v, cage, cageSlots(v, cage.base), w);
    give(lane, w.weightSum, 2e-4f);
    weighPairs(access, v, cage, cageSlots(v, cage.base), w);
    give(lane, w.trust, 1e-3f);
    giveVec3(lane, cornerPlace(access, v, cage, v.firstSlot + 1, 5), 1e-5f);
    give(lane, cellsBetween(access, v, v.firstSlot, v.firstSlot + 1, w.axis, w.up == 1), 1e-5f);
    give(lane, frontWeight(w, w.axis == 0, w.axis == 2, w.up == 1, 2), 1e-4f);
}
