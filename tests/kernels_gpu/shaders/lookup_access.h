// A field of closed form for kernels/lookup and kernels/guards. A point in a map is a direction.
#ifndef PROBEGI_TESTS_KERNELS_GPU_SHADERS_LOOKUP_ACCESS_H
#define PROBEGI_TESTS_KERNELS_GPU_SHADERS_LOOKUP_ACCESS_H

#include "kernels/lookup/access.h"

KERNELS_BEGIN

struct Access {
    int rules;
    int guard;
    float selfShadowBias;
    int maskTexels;
    int maskPacked;
    int blockers;
    float walls;  // share of backs of every third probe
#ifdef __cplusplus
    using MapPoint = vec3;
#endif
};
#ifndef __cplusplus
#define MapPoint vec3
#endif

KERNEL_FN Access accessTo(int rules, int guard, float walls) {
    Access access;
    access.rules = rules;
    access.guard = guard;
    access.selfShadowBias = 0.3f;
    access.maskTexels = 5;
    access.maskPacked = 0;
    access.blockers = 6;
    access.walls = walls;
    return access;
}

KERNEL_FN vec3 visibilityPoint(Access, vec3 direction) {
    return direction / (length(direction) + 1e-6f);
}
KERNEL_FN vec3 irradiancePoint(Access, vec3 normal) {
    return normal;
}
KERNEL_FN vec3 axisPoint(Access access, Volume v, int axis, bool up) {
    return visibilityPoint(access, axisDirection(v, axis, up));
}
KERNEL_FN void storedMoments(Access, int slot, vec3 at, OUT(float) mean, OUT(float) meanSquare) {
    mean = 0.35f + 0.05f * float(slot & 3) + 0.2f * at.x * at.y;
    meanSquare = mean * mean + 0.02f;
}
KERNEL_FN void momentsOnAxis(Access access, Volume, int slot, vec3 at, OUT(float) mean, OUT(float) meanSquare) {
    storedMoments(access, slot, at, mean, meanSquare);
}
KERNEL_FN float storedBackfaceShare(Access access, int slot) {
    return slot % 3 == 0 ? access.walls : 0.0f;
}
KERNEL_FN int storedPlacement(Access, int slot) {
    return int(uint(slot) * 0x9e3779b9u);
}
KERNEL_FN vec3 storedIrradiance(Access, int slot, vec3 at) {
    return vec3(0.9f + 0.1f * float(slot & 3), 1.0f + 0.2f * at.z, 0.5f + 0.02f * float(slot % 11));
}
KERNEL_FN float givenVisibility(Access, int corner) {
    return corner == 5 ? 0.5f : 1.0f;
}
// Cubes begin anywhere; every fourth word is blind. No walls: on which side of one a point is depends on rounding.
KERNEL_FN int maskWord(Access, int number) {
    if (number == 11) return 0x2a05;  // the probe in slot 5
    return number % 4 == 0 ? 0 : int((uint(number) * 0x9e3779b9u) >> 1u) & 0xf000f;
}
// Walls, posts and balls between the probes, one of each shape, of which two are turned.
KERNEL_FN SdfBlocker blockerAt(Access, int number) {
    SdfBlocker blocker;
    blocker.solid.centre = vec3(0.3f * float(number), 0.17f * float(number), 0.9f - 0.23f * float(number));
    blocker.solid.shape = number == 5 ? kSdfBox : uint(number);
    blocker.solid.rotation = number == 2 || number == 5 ? vec4(0.6f, 0.0f, 0.0f, 0.8f) : vec4(0.0f, 0.0f, 0.0f, 1.0f);
    blocker.solid.halfSize = vec3(0.1f, 0.4f, 0.3f);
    blocker.solid.rounding = 0.03f;
    blocker.reach = vec3(0.55f);
    return blocker;
}
KERNEL_FN void countFallback(Access) {}

KERNELS_END

#endif
