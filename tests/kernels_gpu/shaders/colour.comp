#include "lane.h"

#include "kernels/screen/colour.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 color = takeVector(lane, 0.0f, 20.0f);
    const float value = takeUnit(lane);
    const float dark = takeBetween(lane, 0.0f, 0.05f);
    give(lane, luminance(color), 1e-6f);
    giveBits(lane, uint(anyPositive(floor(color - 18.0f))));
    give(lane, encodeSrgb(value), 2e-6f);
    give(lane, decodeSrgb(value), 2e-6f);
    give(lane, encodeSrgb(dark), 2e-6f);
    give(lane, decodeSrgb(dark), 2e-6f);
}
