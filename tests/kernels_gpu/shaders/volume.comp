#include "lane.h"

#include "some_volume.h"

#include "kernels/volume/volume.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const ivec3 cell = takeCell(lane, v);
    const int slot = probeSlot(v, cell);
    giveBits(lane, uint(slot));
    giveBits(lane, uint(ringPlace(cell.x, v.phase.x, v.counts.x)));
    giveCell(lane, probeCell(v, slot));
    giveBits(lane, uint(probeNumber(v, slot)));
    giveBits(lane, hasEntered(v, cell, ivec3(2, 0, -1)) ? 1u : 0u);
    giveBits(lane, uint(volumeProbes(v)));
    giveBits(lane, isInVolume(v, cell + ivec3(0, 1, 0)) ? 1u : 0u);
    giveBits(lane, isInVolume(v, cell - ivec3(1, 0, 0)) ? 1u : 0u);
    giveVec3(lane, probePlace(v, cell), 2e-6f);
}
