#include "kernels/shade/bounce.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

// Lambert: radiosity albedo * E, divided by the hemisphere's pi.
TEST(Bounce, isLambertOfTheAlbedo) {
    const vec3 light = bounceRadiance({0.5f, 0.25f, 0.0f}, {4, 8, 2});
    EXPECT_NEAR(light.x, 2 / 3.14159265, 1e-6);
    EXPECT_NEAR(light.y, 2 / 3.14159265, 1e-6);
    EXPECT_EQ(light.z, 0.0f);
}

// The sum of all bounces stays finite: E = E0 / (1 - albedo).
TEST(Bounce, noSurfaceReflectsAllLight) {
    for (const float albedo : {0.995f, 1.0f, 1.5f})
        EXPECT_NEAR(bounceRadiance(vec3(albedo), vec3(1.0f)).y, 0.99 / 3.14159265, 1e-6);
    EXPECT_NEAR(bounceRadiance(vec3(0.985f), vec3(1.0f)).x, 0.985 / 3.14159265, 1e-6);
}

}  // namespace
}  // namespace probegi::kernels
