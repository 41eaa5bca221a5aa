#include "lane.h"

#include "some_volume.h"

#include "kernels/volume/probe_offset.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const uint placement = takeBits(lane);
    giveVec3(lane, probeOffset(v, int(placement)), 1e-6f);
}
