#include "lane.h"

#include "kernels/screen/pinhole.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 origin = takeVector(lane, -10.0f, 10.0f);
    const vec3 forward = takeDirection(lane);
    const vec3 up = normalize(cross(forward, vec3(0.3f, 0.7f, 0.1f)) + forward * 1e-6f);
    const float yfov = takeBetween(lane, 0.1f, 2.5f);
    const int width = 1 + takeIndex(lane, 4096);
    const int height = 1 + takeIndex(lane, 4096);
    const PinholeCamera camera = makePinhole(origin, forward, up, yfov, width, height);
    giveVec3(lane, camera.corner, 1e-4f);
    const float x = takeBetween(lane, 0.0f, float(width));
    const float y = takeBetween(lane, 0.0f, float(height));
    giveVec3(lane, pinholeDirection(camera, x, y), 1e-4f);
    const int column = takeIndex(lane, width);
    const int row = takeIndex(lane, height);
    giveVec3(lane, subSampleDirection(camera, column, row, takeIndex(lane, 9), 3), 1e-4f);
    give(lane, pinholeSpread(camera, 1 + takeIndex(lane, 8)), 1e-4f);
}
