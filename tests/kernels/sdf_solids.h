#pragma once

#include <array>
#include <random>
#include <vector>

#include "kernels/sdf/primitive.h"

namespace probegi::kernels {

/// Random numbers for tests of primitives.
struct SdfDice {
    std::mt19937 generator{20201u};

    float between(float lower, float upper) {
        return lower + (upper - lower) * float(generator() >> 8) * (1.0f / 16777216.0f);
    }
    vec3 vector(float lower, float upper) {
        const float x = between(lower, upper), y = between(lower, upper), z = between(lower, upper);
        return {x, y, z};
    }
    vec3 direction() {
        for (;;) {
            const vec3 v = vector(-1, 1);
            if (dot(v, v) > 0.01f && dot(v, v) < 1) return normalize(v);
        }
    }
    vec4 rotation() {
        const vec3 axis = direction();
        const float half = between(0, kPi);
        return {axis * sin(half), cos(half)};
    }
};

inline SdfSolid plainSolid(uint shape, vec3 halfSize, float rounding = 0) {
    SdfSolid solid;
    solid.centre = vec3(0.0f);
    solid.shape = shape;
    solid.rotation = {0, 0, 0, 1};
    solid.halfSize = halfSize;
    solid.rounding = rounding;
    return solid;
}

inline constexpr std::array kSdfShapes = {kSdfBox, kSdfRoundedBox, kSdfSphere, kSdfCapsule, kSdfCylinder, kSdfPlane};

/// A solid anywhere within 2 m, turned, of sizes from `smallest` to 1 m.
inline SdfSolid randomSolid(SdfDice& dice, uint shape, float smallest = 0.05f) {
    SdfSolid solid = plainSolid(shape, dice.vector(smallest, 1));
    solid.rounding = min(solid.halfSize.x, min(solid.halfSize.y, solid.halfSize.z)) * dice.between(0.05f, 1);
    solid.centre = dice.vector(-2, 2);
    solid.rotation = dice.rotation();
    return solid;
}

}  // namespace probegi::kernels
