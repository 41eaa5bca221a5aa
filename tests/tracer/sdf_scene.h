#pragma once

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

#include "probegi/sdf.h"

namespace probegi::test {

/// Random numbers for scenes of primitives.
struct SdfDice {
    std::mt19937 generator{7u};

    float between(float lower, float upper) {
        return lower + (upper - lower) * float(generator() >> 8) * (1.0f / 16777216.0f);
    }
    glm::vec3 vector(float lower, float upper) {
        const float x = between(lower, upper), y = between(lower, upper), z = between(lower, upper);
        return {x, y, z};
    }
    glm::vec3 direction() {
        for (;;) {
            const glm::vec3 v = vector(-1, 1);
            if (glm::dot(v, v) > 0.01f && glm::dot(v, v) < 1) return glm::normalize(v);
        }
    }
};

inline SdfPrimitive sdfBox(glm::vec3 lower, glm::vec3 upper) {
    SdfPrimitive box;
    box.centre = 0.5f * (lower + upper);
    box.halfSize = 0.5f * (upper - lower);
    return box;
}

inline SdfPrimitive sdfSphere(glm::vec3 centre, float radius) {
    SdfPrimitive sphere;
    sphere.shape = SdfShape::sphere;
    sphere.centre = centre;
    sphere.halfSize.x = radius;
    return sphere;
}

/// Of all shapes, turned but for every third, in a space of 8 m.
inline SdfScene randomPrimitives(SdfDice& dice, int count) {
    SdfScene sdf;
    for (int i = 0; i < count; ++i) {
        SdfPrimitive p;
        p.shape = i % 2 == 0 ? SdfShape::box : SdfShape(i / 2 % 5);
        p.centre = dice.vector(-4, 4);
        p.halfSize = dice.vector(0.05f, 0.8f);
        p.rounding = p.shape == SdfShape::roundedBox ? 0.05f : 0.0f;
        if (i % 3 != 0) p.rotation = glm::angleAxis(dice.between(0, 3), dice.direction());
        p.albedo = dice.vector(0, 1);
        p.emission = dice.vector(0, 5);
        sdf.primitives.push_back(p);
    }
    SdfPrimitive ground;
    ground.shape = SdfShape::plane;
    ground.centre.y = -4;
    sdf.primitives.push_back(ground);
    return sdf;
}

}  // namespace probegi::test
