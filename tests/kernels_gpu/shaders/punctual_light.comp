#include "lane.h"

#include "kernels/light/punctual_light.h"

void giveSample(INOUT(Lane) lane, LightSample s, float tolerance) {
    giveVec3(lane, s.toLight, 2e-6f);
    give(lane, s.distance, 1e-6f);
    giveVec3(lane, s.irradianceAtNormal, tolerance);
}

// The cone's ramp amplifies the rounding of the cosine by 1 / (cosInner - cosOuter), the inverse square that of small
// distances.
void evaluate(INOUT(Lane) lane) {
    const vec3 direction = takeDirection(lane);
    const vec3 light = takeVector(lane, -5.0f, 5.0f);
    const vec3 away = takeDirection(lane);
    const vec3 point = light + away * takeBetween(lane, 0.1f, 20.0f);
    const vec3 intensity = takeVector(lane, 0.0f, 100.0f);
    const float range = takeBetween(lane, 0.0f, 25.0f);
    const float cosOuter = takeBetween(lane, -0.5f, 0.8f);
    const float cosInner = cosOuter + 0.1f;

    give(lane, punctualRangeWindow(takeBetween(lane, 0.0f, 30.0f), range), 1e-4f);
    give(lane, punctualConeFactor(takeBetween(lane, -1.0f, 1.0f), cosInner, cosOuter), 2e-5f);
    for (int type = kLightDirectional; type <= kLightSpot; ++type) {
        giveSample(lane, samplePunctual(type, light, direction, intensity, 0.0f, cosInner, cosOuter, point), 2e-4f);
    }
    giveSample(lane, samplePunctual(kLightPoint, light, direction, intensity, 0.0f, cosInner, cosOuter, light), 0.0f);

    // Along the axes and on whole numbers, so that no sign hangs on a rounding.
    LightSample whole;
    whole.toLight = floor(direction * 4.0f);
    whole.distance = 1.0f;
    whole.irradianceAtNormal = max(floor(intensity * 0.04f) - 2.0f, vec3(0.0f));
    giveBits(lane, reachesSurface(whole, floor(away * 4.0f), floor(light)) ? 1u : 0u);
}
