#include "lane.h"

#include "kernels/language.h"

// The built-in functions that kernels may use. Vulkan requires only 2^-11 of sin and cos, and less of tan and pow. The
// kernels need more precision, so devices that fall short must fail here rather than in pictures.
void giveScalars(INOUT(Lane) lane, float x, float unit) {
    give(lane, kPi, 0.0f);
    give(lane, sin(x), 2e-5f);
    give(lane, cos(x), 2e-5f);
    give(lane, acos(2.0f * unit - 1.0f), 5e-4f);
    give(lane, atan(unit + 0.1f, x), 5e-6f);
    give(lane, sqrt(unit), 1e-6f);
    give(lane, inversesqrt(unit + 0.01f), 1e-5f);
    give(lane, exp(x), 1e-5f);
    give(lane, exp2(x), 1e-5f);
    give(lane, log2(unit + 0.01f), 1e-5f);
    give(lane, pow(unit + 1e-6f, 0.2f), 1e-5f);
    give(lane, pow(unit, 50.0f), 1e-5f);
    give(lane, floor(x), 0.0f);
    give(lane, fract(x), 0.0f);
    give(lane, clamp(x, -1.0f, 1.0f), 0.0f);
    give(lane, mix(1.0f, 3.0f, unit), 1e-6f);
    give(lane, uintBitsToFloat(floatBitsToUint(x)), 0.0f);
    giveBits(lane, floatBitsToUint(abs(x)));
    giveBits(lane, uint(bitCount(floatBitsToUint(x))));
    giveBits(lane, uint(findLSB(floatBitsToUint(x))));
    giveBits(lane, uint(findMSB(floatBitsToUint(unit))));
}

void giveVectors(INOUT(Lane) lane, vec3 a, vec3 b) {
    give(lane, dot(a, b), 1e-6f);
    give(lane, length(a), 1e-6f);
    giveVec3(lane, cross(a, b), 1e-6f);
    giveVec3(lane, reflect(a, b), 1e-5f);
    giveVec3(lane, min(a, b) + max(a, b), 1e-6f);
    giveVec3(lane, mat3(a, b, vec3(1.0f, 2.0f, 3.0f)) * a, 1e-5f);
}

void evaluate(INOUT(Lane) lane) {
    const float x = takeBetween(lane, -8.0f, 8.0f);
    const float unit = takeUnit(lane);
    const vec3 a = takeDirection(lane);
    const vec3 b = takeDirection(lane);
    giveScalars(lane, x, unit);
    giveVectors(lane, a, b);
}
