#include "lane.h"

#include "kernels/trace/bvh_scene.h"

void evaluate(INOUT(Lane) lane) {
    BvhInstance placed;
    placed.row0 = vec4(takeVector(lane, -2.0f, 2.0f), 0.25f);
    placed.row1 = vec4(takeVector(lane, -2.0f, 2.0f), 3.0f);
    placed.row2 = vec4(takeVector(lane, -2.0f, 2.0f), -1.0f);
    placed.root = kBvhNone;
    placed.number = kBvhStackSize;
    const vec3 p = takeVector(lane, -4.0f, 4.0f);
    giveVec3(lane, bvhInstancePoint(placed, p), 1e-5f);
    giveVec3(lane, bvhInstanceVector(placed, p), 1e-5f);
}
