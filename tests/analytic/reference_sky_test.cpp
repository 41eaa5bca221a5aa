// Light from infinitely far away.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/irradiance_estimate.h"
#include "scene/sky_radiance.h"
#include "support/reference_world.h"

namespace probegi {
namespace {

using namespace test;

constexpr float kPi = 3.14159265f;

Scene plane(float albedo) {
    Scene scene;
    addQuad(scene, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, addMaterial(scene, glm::vec3(albedo)));
    return scene;
}

/// A constant sky L over an open plane: E(up) = pi L on it, 0 below it.
TEST(OpenPlane, constantSky) {
    Scene scene = plane(0.7f);
    scene.sky.radiance = {2, 1, 0.5f};
    const ReferenceWorld world(scene);
    const std::vector<FieldQuery> points = {{{0, 0, 0}, {0, 1, 0}, {}}, {{0, -1e-3f, 0}, {0, 1, 0}, {}}};
    const auto e = world.pathTracer().irradiance(points, 2000);
    ASSERT_TRUE(e);
    expectNear((*e)[0], scene.sky.radiance * kPi);
    expectSharp((*e)[0], 1e-4f);
    EXPECT_EQ((*e)[1].mean, glm::vec3(0.0f));
}

/// A wall sees half the sky and half the plane, whose radiance is a L: E = pi L (1 + a) / 2, up to the plane's end.
TEST(OpenPlane, aPointThatFacesSideways) {
    Scene scene = plane(0.6f);
    scene.sky.radiance = glm::vec3(1.0f);
    const ReferenceWorld world(scene);
    const FieldQuery sideways{{0, 1e-3f, 0}, {1, 0, 0}, {}};
    const auto e = world.pathTracer().irradiance({&sideways, 1}, 8000);
    ASSERT_TRUE(e);
    expectNear(e->front(), glm::vec3(kPi * 0.8f));
}

/// One bright texel at 45 degrees. The truth is the integral of the bilinear look-up times the cosine, by quadrature.
Scene brightTexel() {
    Scene scene = plane(0.0f);
    scene.sky.radiance = glm::vec3(1.0f);
    scene.sky.image = HdrImage(16, 8);
    scene.sky.image.at(5, 1) = {100, 200, 50};
    return scene;
}

glm::dvec3 skyIrradiance(const Sky& sky, glm::dvec3 normal) {
    glm::dvec3 sum(0.0);
    constexpr int kSteps = 800;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < 2 * kSteps; ++i) {
            const double theta = (j + 0.5) / kSteps * double(kPi), phi = (i + 0.5) / kSteps * double(kPi);
            const glm::dvec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
            const double cosine = glm::dot(d, normal);
            if (cosine > 0) sum += glm::dvec3(skyRadiance(sky, glm::vec3(d))) * (cosine * std::sin(theta));
        }
    return sum * (double(kPi) / kSteps * double(kPi) / kSteps);
}

TEST(TexturedSky, oneBrightTexel) {
    const Scene scene = brightTexel();
    const ReferenceWorld world(scene);
    const glm::vec3 truth(skyIrradiance(scene.sky, {0, 1, 0}));
    for (const Strategy strategy : {Strategy::both, Strategy::bsdfOnly, Strategy::lightsOnly}) {
        const auto e = estimateIrradiance(world.context, world.transport(), {true, 0, strategy},
                                          std::vector<FieldQuery>(1), 20000, 5);
        ASSERT_TRUE(e);
        expectNear(e->front(), truth);
        expectSharp(e->front(), strategy == Strategy::bsdfOnly ? 0.05f : 0.01f);
    }
}

/// Directions are sampled with the density that pdf() claims: the density integrates to 1, and the estimate of the
/// integral of the sky agrees with quadrature.
TEST(TexturedSky, densityIntegratesToOne) {
    const SkyLight light(brightTexel().sky);
    double integral = 0;
    constexpr int kSteps = 400;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < 2 * kSteps; ++i) {
            const double theta = (j + 0.5) / kSteps * double(kPi), phi = (i + 0.5) / kSteps * double(kPi);
            const glm::dvec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
            integral += double(light.pdf({0, 1, 0}, glm::vec3(d))) * std::sin(theta);
        }
    EXPECT_NEAR(integral * std::pow(double(kPi) / kSteps, 2), 1.0, 0.01);

    Random random(1, 2);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 d = light.sample({0, 1, 0}, random);
        EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
        EXPECT_GT(light.pdf({0, 1, 0}, d), 0.0f);
    }
}

TEST(TexturedSky, ofOneColourEqualsTheConstantSky) {
    Scene scene = plane(0.5f);
    scene.sky.radiance = glm::vec3(2.0f);
    scene.sky.image = HdrImage(8, 4, glm::vec3(0.5f));
    const ReferenceWorld world(scene);
    expectNear(world.pathTracer().irradiance(std::vector<FieldQuery>(1), 4000)->front(), glm::vec3(kPi));
}

/// NVIDIA's furnace test: albedo exactly 1 under a white sky of 1 vanishes against it.
TEST(WhitePlane, vanishesAgainstTheSky) {
    Scene scene = plane(1.0f);
    scene.sky.radiance = glm::vec3(1.0f);
    const ReferenceWorld world(scene);
    ReferenceDesc desc;
    desc.picture = {.camera = lookAt({0, 2, 4}, {0, 0, 0}), .width = 8, .height = 8, .diffuseOnly = true};
    desc.samplesPerPixel = 16;
    const auto result = world.pathTracer().render(desc);
    ASSERT_TRUE(result);
    for (const glm::vec3& pixel : result->picture.color.pixels) EXPECT_NEAR(pixel.x, 1.0f, 1e-4f);
}

}  // namespace
}  // namespace probegi
