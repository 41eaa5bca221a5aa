#include "lane.h"

#include "kernels/light/sky.h"

// Avoids the seam, where u jumps from 1 to 0.
vec3 takeAhead(INOUT(Lane) lane) {
    const vec3 v = takeVector(lane, -1.0f, 1.0f);
    return normalize(vec3(v.x, v.y, -abs(v.z) - 0.01f));
}

void giveTexels(INOUT(Lane) lane, SkyTexels t) {
    giveBits(lane, uint(t.left));
    giveBits(lane, uint(t.right));
    giveBits(lane, uint(t.upper));
    giveBits(lane, uint(t.lower));
    give(lane, t.alongX, 1e-4f);
    give(lane, t.alongY, 1e-4f);
}

// Points on a grid of eighths of a texel, so that rounding moves none across a texel's edge.
void evaluate(INOUT(Lane) lane) {
    const vec3 direction = takeAhead(lane);
    const int width = 2 << takeIndex(lane, 6);
    const int height = 1 << takeIndex(lane, 6);
    const float column = (float(takeIndex(lane, 8 * width)) + 0.5f) * 0.125f;
    const float row = (float(takeIndex(lane, 8 * height)) + 0.5f) * 0.125f;
    const vec2 uv = vec2(column / float(width), row / float(height));
    giveVec2(lane, skyUv(direction), 4e-6f);
    giveVec2(lane, skyUv(vec3(0.0f, 1.0f, 0.0f)), 1e-6f);
    giveVec2(lane, skyUv(vec3(0.0f, -1.0f, 0.0f)), 1e-6f);
    const SkyTexels t = skyTexels(uv, width, height);
    giveTexels(lane, t);
    giveTexels(lane, skyTexels(vec2(0.0f), width, height));
    giveTexels(lane, skyTexels(vec2(1.0f), width, height));
    const vec3 a = takeVector(lane, 0.0f, 9.0f);
    const vec3 b = takeVector(lane, 0.0f, 9.0f);
    const vec3 c = takeVector(lane, 0.0f, 9.0f);
    const vec3 d = takeVector(lane, 0.0f, 9.0f);
    giveVec3(lane, blendSky(t, a, b, c, d), 1e-5f);
}
