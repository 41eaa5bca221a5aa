#include "lane.h"

#include "some_volume.h"

#include "kernels/abi/field_constants.h"

void evaluate(INOUT(Lane) lane) {
    FieldConstants constants;
    constants.volumes[kMostVolumes - 1] = takeVolume(lane);
    constants.blending.order[kMostVolumes - 1] = takeIndex(lane, 9);
    giveBits(lane, uint(constants.blending.order[kMostVolumes - 1]));
    giveBits(lane, uint(volumeProbes(constants.volumes[kMostVolumes - 1])));
}
