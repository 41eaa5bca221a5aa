#include "lane.h"

#include "some_volume.h"

#include "kernels/volume/placed_probe.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const ivec3 cell = takeCell(lane, v);
    const uint placement = takeBits(lane);
    const vec3 share = takeVector(lane, -0.6f, 0.6f);
    giveBits(lane, packOffsetAxis(floor(share.x * 100.0f) * 0.01f));
    const vec3 offset = probeOffset(v, int(placement));
    giveBits(lane, withOffset(v, placement, offset));
    giveVec3(lane, placedPosition(v, cell, placement), 2e-5f);
}
