#include "lane.h"

#include "some_volume.h"

#include "kernels/volume/volume_weight.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const vec3 point = takeVector(lane, -8.0f, 8.0f);
    const vec3 camera = takeVector(lane, -8.0f, 8.0f);
    give(lane, cellsInBox(point, camera, vec3(2.0f)), 1e-5f);
    const float cells = cellsInVolume(v, point);
    give(lane, cells, 1e-4f);
    give(lane, cellsInTrackingVolume(v, point, camera), 1e-4f);
    give(lane, volumeWeight(cells), 1e-4f);
    const float coverage = volumeCoverage(cells);
    give(lane, coverage, 1e-4f);
    giveVec3(lane, withOutside(abs(point), coverage, abs(camera)), 1e-3f);
}
