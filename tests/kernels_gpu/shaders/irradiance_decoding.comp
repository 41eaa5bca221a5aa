#include "lane.h"

#include "kernels/probe/irradiance_decoding.h"

void evaluate(INOUT(Lane) lane) {
    const float stored = takeBetween(lane, 0.0f, 64.0f);
    give(lane, decodeIrradiance(stored), 2e-6f);
    give(lane, decodeToBlendSpace(stored), 2e-6f);
}
