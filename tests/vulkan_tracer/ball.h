// The wall of a ball: what both tracers of it have in common, one text for GLSL and C++.
#ifndef PROBEGI_TESTS_BALL_H
#define PROBEGI_TESTS_BALL_H

#include "kernels/language.h"

KERNELS_BEGIN

struct Ball {
    vec3 centre;
    float radius;
};

// Where a ray meets the wall first, metres along it between near and far; negative: nowhere.
KERNEL_FN float ballDistance(Ball ball, vec3 origin, vec3 direction, float near, float far) {
    const vec3 o = origin - ball.centre;
    const float along = dot(o, direction);
    const float square = along * along - dot(o, o) + ball.radius * ball.radius;
    if (!(square >= 0.0f)) return -1.0f;
    const float entry = -along - sqrt(square);
    const float exit = -along + sqrt(square);
    if (entry > near && entry < far) return entry;
    return exit > near && exit < far ? exit : -1.0f;
}

// Unit, outwards.
KERNEL_FN vec3 ballNormal(Ball ball, vec3 position) {
    return normalize(position - ball.centre);
}

KERNELS_END

#endif
