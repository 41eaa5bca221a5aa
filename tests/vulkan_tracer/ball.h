// The wall of a ball: code shared by its two tracers, in GLSL and C++.
#ifndef PROBEGI_TESTS_BALL_H
#define PROBEGI_TESTS_BALL_H

#include "kernels/language.h"

KERNELS_BEGIN

struct Ball {
    vec3 centre;
    float radius;
};

// Distance in metres to the first hit of the wall between near and far; negative: none.
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

// Unit vector, outwards.
KERNEL_FN vec3 ballNormal(Ball ball, vec3 position) {
    return normalize(position - ball.centre);
}

KERNELS_END

#endif
