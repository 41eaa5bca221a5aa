#include "lane.h"

#include "kernels/screen/tone_map.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 color = takeVector(lane, -1.0f, 3.0f);
    const float exposure = takeBetween(lane, 0.1f, 3.0f);
    const float huge = takeBetween(lane, 0.0f, 2e7f);
    const int x = takeIndex(lane, 1 << 14);
    const int y = takeIndex(lane, 1 << 14);
    give(lane, ditherThreshold(x, y), 0.0f);
    const uvec3 codes = displayCodes(clamp(color, vec3(0.0f), vec3(1.0f)), x > y, x, y);
    for (int c = 0; c < 3; ++c) give(lane, float(codes[c]), 0.0f);
    give(lane, filmicShoulder(takeBetween(lane, 0.0f, 3.0f)), 1e-6f);
    giveVec3(lane, filmicCurve(abs(color)), 2e-6f);
    give(lane, displayable(color.x), 0.0f);
    give(lane, displayable(huge), 0.0f);
    giveVec3(lane, toneMap(color, exposure, false), 4e-6f);
    giveVec3(lane, toneMap(color, exposure, true), 4e-6f);
    giveVec3(lane, toneMap(vec3(huge, 0.0f, 0.0f), exposure, true), 4e-6f);
}
