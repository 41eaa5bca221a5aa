#include "lane.h"

#include "kernels/probe/irradiance_encoding.h"

// Over the twelve decades of the format, including zero and negative values.
void evaluate(INOUT(Lane) lane) {
    const float mean = exp2(takeBetween(lane, -40.0f, 40.0f));
    const float stored = encodeIrradiance(mean);
    give(lane, stored, 1e-6f);
    give(lane, encodeIrradiance(0.0f), 0.0f);
    give(lane, encodeIrradiance(1e-32f), 0.0f);
    give(lane, decodeIrradiance(stored), 5e-6f);
    give(lane, decodeToBlendSpace(stored), 5e-6f);
}
