#include "kernels/screen/pixel_layers.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

// A pixel of four samples, of which three show one surface and one the sky.
TEST(PixelLayers, areMeansOverSkyAndSurfaces) {
    PixelLayers sums = emptyLayers();
    for (int i = 0; i < 3; ++i) addSurface(sums, {1, 2, 4}, vec3(kPi), {0.5f, 0.25f, 1}, {0, 1, 0}, 8.0f);
    addSky(sums, {4, 8, 16});
    const PixelLayers means = meanLayers(sums, 4);
    EXPECT_EQ(means.direct, vec3(0.75f, 1.5f, 3));
    const vec3 indirect(0.375f, 0.1875f, 0.75f);  // albedo * E / pi, of three in four
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(means.indirect[c], indirect[c], 1e-6f);
        EXPECT_NEAR(means.color[c], means.direct[c] + indirect[c] + vec3(1, 2, 4)[c], 1e-6f);
        EXPECT_NEAR(means.irradiance[c], 0.75f * kPi, 1e-6f);
    }
    EXPECT_EQ(means.albedo, vec3(0.375f, 0.1875f, 0.75f));
    EXPECT_EQ(means.normal, vec3(0, 0.75f, 0));
    EXPECT_EQ(means.depth, 6.0f);
}

TEST(PixelLayers, glossyLightIsPartOfTheIndirect) {
    PixelLayers sums = emptyLayers();
    addGlossySurface(sums, {1, 2, 4}, vec3(5), {2, 4, 8}, {1, 3, 5}, vec3(0.5f), {0, 1, 0}, 8.0f);
    addSky(sums, vec3(2));
    const PixelLayers means = meanLayers(sums, 2);
    EXPECT_EQ(means.direct, vec3(0.5f, 1, 2));
    EXPECT_EQ(means.indirect, vec3(1.5f, 3.5f, 6.5f));
    EXPECT_EQ(means.glossy, vec3(0.5f, 1.5f, 2.5f));
    EXPECT_EQ(means.color, vec3(3, 5.5f, 9.5f));
    EXPECT_EQ(means.irradiance, vec3(2.5f));
    EXPECT_EQ(means.depth, 4.0f);
}

TEST(PixelLayers, contactLightIsBesideTheRest) {
    PixelLayers sums = emptyLayers();
    addContactLayers(sums, {1, 2, 4}, 0.25f);
    addSky(sums, vec3(2));
    const PixelLayers means = meanLayers(sums, 2);
    EXPECT_EQ(means.contact, vec3(0.5f, 1, 2));
    EXPECT_EQ(means.openness, 0.375f);
    EXPECT_EQ(means.indirect, vec3(0.0f));
}

TEST(PixelLayers, skyIsInTheColourAlone) {
    PixelLayers sums = emptyLayers();
    addSky(sums, {1, 2, 3});
    const PixelLayers means = meanLayers(sums, 1);
    EXPECT_EQ(means.color, vec3(1, 2, 3));
    EXPECT_EQ(means.direct + means.indirect + means.irradiance + means.albedo + means.normal, vec3(0.0f));
    EXPECT_EQ(means.depth, 0.0f);
}

}  // namespace
}  // namespace probegi::kernels
