#include "lane.h"

#include "kernels/abi/field_constants.h"

// Structs only: that both languages know them by the same members.
void evaluate(INOUT(Lane) lane) {
    FieldConstants constants;
    constants.volumeCount = takeIndex(lane, kMostVolumes);
    constants.guard = kGuardMoments;
    constants.volumes[1].firstSlot = takeIndex(lane, 1000);
    giveBits(lane, uint(constants.volumeCount + constants.guard - kGuardNone + constants.volumes[1].firstSlot));
}
