#include "kernels/light/sky.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

void expectUv(vec3 direction, float u, float v) {
    const vec2 uv = skyUv(direction);
    EXPECT_NEAR(uv.x, u, 1e-6) << direction.x << ' ' << direction.y << ' ' << direction.z;
    EXPECT_NEAR(uv.y, v, 1e-6) << direction.x << ' ' << direction.y << ' ' << direction.z;
}

TEST(Sky, axesLieWhereTheImageHasThem) {
    expectUv({0, 0, -1}, 0.5f, 0.5f);
    expectUv({1, 0, 0}, 0.75f, 0.5f);
    expectUv({-1, 0, 0}, 0.25f, 0.5f);
    expectUv({0, 1, 0}, 0.5f, 0.0f);
    expectUv({0, -1, 0}, 0.5f, 1.0f);
    const float r = std::sqrt(0.5f);
    expectUv({r, 0, -r}, 0.625f, 0.5f);
    expectUv({0, r, -r}, 0.5f, 0.25f);
    expectUv({r, -r, 0}, 0.75f, 0.75f);
    EXPECT_NEAR(std::abs(skyUv({0, 0, 1}).x - 0.5f), 0.5f, 1e-6) << "behind: the edge";
    // The angle is exact to float precision near a pole too.
    EXPECT_NEAR(skyUv({1e-4f, 1, 0}).y / (1e-4f / kPi), 1, 1e-5);
}

TEST(Sky, texelsAreCentredAndWrapAround) {
    const SkyTexels middle = skyTexels({0.5f, 0.5f}, 8, 4);
    EXPECT_EQ(middle.left, 3);
    EXPECT_EQ(middle.right, 4);
    EXPECT_EQ(middle.upper, 1);
    EXPECT_EQ(middle.lower, 2);
    EXPECT_FLOAT_EQ(middle.alongX, 0.5f);
    EXPECT_FLOAT_EQ(middle.alongY, 0.5f);
    const SkyTexels centre = skyTexels({2.5f / 8, 1.5f / 4}, 8, 4);
    EXPECT_EQ(centre.left, 2);
    EXPECT_EQ(centre.upper, 1);
    EXPECT_FLOAT_EQ(centre.alongX, 0.0f);
    EXPECT_FLOAT_EQ(centre.alongY, 0.0f);
    const SkyTexels first = skyTexels({0.0f, 0.0f}, 8, 4);
    EXPECT_EQ(first.left, 7);
    EXPECT_EQ(first.right, 0);
    EXPECT_FLOAT_EQ(first.alongX, 0.5f);
    EXPECT_EQ(first.upper, 0);
    EXPECT_EQ(first.lower, 1);
    EXPECT_FLOAT_EQ(first.alongY, 0.0f) << "nothing above the top row";
    const SkyTexels last = skyTexels({1.0f, 1.0f}, 8, 4);
    EXPECT_EQ(last.left, 7);
    EXPECT_EQ(last.right, 0);
    EXPECT_EQ(last.upper, 3);
    EXPECT_EQ(last.lower, 3);
    const SkyTexels quarter = skyTexels({2.75f / 8, 1.75f / 4}, 8, 4);
    EXPECT_FLOAT_EQ(quarter.alongX, 0.25f);
    EXPECT_FLOAT_EQ(quarter.alongY, 0.25f);
}

TEST(Sky, texelsStayInsideWhateverUvIs) {
    for (const float at : {-9.0f, -1e-3f, 1.001f, 40.0f})
        for (const auto& [width, height] : {std::pair{1, 1}, {8, 4}}) {
            const SkyTexels t = skyTexels({at, at}, width, height);
            EXPECT_TRUE(t.left >= 0 && t.left < width && t.right >= 0 && t.right < width) << at;
            EXPECT_TRUE(t.upper >= 0 && t.upper < height && t.lower >= 0 && t.lower < height) << at;
        }
}

TEST(Sky, blendIsBilinear) {
    SkyTexels t{};
    t.alongX = 0.25f;
    t.alongY = 0.5f;
    const vec3 blend = blendSky(t, vec3(0.0f), vec3(4.0f), vec3(8.0f), vec3(16.0f));
    EXPECT_FLOAT_EQ(blend.x, 0.5f * (0.75f * 0 + 0.25f * 4) + 0.5f * (0.75f * 8 + 0.25f * 16));
}

}  // namespace
}  // namespace probegi::kernels
