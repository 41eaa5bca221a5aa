#include "lane.h"

#include "some_volume.h"

#include "kernels/volume/volume_frame.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const ivec3 cell = takeCell(lane, v);
    const vec3 a = takeVector(lane, -3.0f, 3.0f);
    giveVec3(lane, turnedBy(vec3(v.orientation.x, v.orientation.y, v.orientation.z), v.orientation.w, a), 1e-5f);
    giveVec3(lane, toVolumeDirection(v, a), 1e-5f);
    giveVec3(lane, toWorldDirection(v, a), 1e-5f);
    giveVec3(lane, toVolumePoint(v, a), 2e-5f);
    giveVec3(lane, probePosition(v, cell), 2e-5f);
}
