#include "lane.h"

#include "kernels/probe/octahedral.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 direction = takeDirection(lane);
    const vec2 point = 2.0f * takeUnit2(lane) - vec2(1.0f, 1.0f);
    giveVec2(lane, octEncode(direction), 1e-6f);
    giveVec2(lane, octEncode(direction * 7.0f), 1e-6f);
    giveVec3(lane, octDecode(point), 1e-6f);
    giveVec3(lane, octDecode(octEncode(direction)), 2e-6f);
    giveVec2(lane, octTexelPosition(point, 8), 1e-6f);
}
