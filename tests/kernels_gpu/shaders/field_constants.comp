#include "lane.h"

#include "some_volume.h"

#include "kernels/abi/field_constants.h"

void evaluate(INOUT(Lane) lane) {
    FieldConstants constants;
    constants.volumes[kMostVolumes - 1] = takeVolume(lane);
    giveBits(lane, uint(volumeProbes(constants.volumes[kMostVolumes - 1])));
}
