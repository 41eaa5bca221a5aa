#include "kernels/trace/ray_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace probegi::kernels {
namespace {

// Equal steps in height, turned by the golden ratio (in doubles).
TEST(RaySet, fibonacciByDefinition) {
    for (const uint count : {9u, 144u, 4096u})
        for (const uint i : {0u, 1u, 4u, count - 1}) {
            const double height = 1 - (2.0 * i + 1) / count, radius = std::sqrt(1 - height * height);
            const double phi = 2 * M_PI * std::fmod(i * 0.6180339887498949, 1.0);
            const vec3 d = sphericalFibonacci(i, count);
            EXPECT_NEAR(d.x, radius * std::cos(phi), 2e-6) << i << " of " << count;
            EXPECT_NEAR(d.y, radius * std::sin(phi), 2e-6) << i << " of " << count;
            EXPECT_NEAR(d.z, height, 1e-6) << i << " of " << count;
        }
}

// Shoemake's quaternion, as a matrix.
TEST(RaySet, rotationIsThatOfTheQuaternion) {
    for (const vec3 u : {vec3(0, 0.1f, 0.2f), vec3(1, 0.3f, 0.125f), vec3(0.3f, 0.7f, 0.9f), vec3(0.8f, 0.05f, 0.4f)}) {
        const float a = std::sqrt(1 - u.x), b = std::sqrt(u.x), turn = 2 * kPi;
        const glm::quat q(b * std::cos(turn * u.z), a * std::sin(turn * u.y), a * std::cos(turn * u.y),
                          b * std::sin(turn * u.z));
        const mat3 truth = glm::mat3_cast(q), rotation = randomRotation(u.x, u.y, u.z);
        for (int column = 0; column < 3; ++column) EXPECT_NEAR(length(rotation[column] - truth[column]), 0, 2e-6);
    }
}

}  // namespace
}  // namespace probegi::kernels
