// Closed boxes and spheres whose light is known; docs/accuracy.md lists the same closed forms for the field.
#include <gtest/gtest.h>

#include "probegi/builtin_scenes.h"
#include "support/analytic_tracer.h"
#include "support/reference_world.h"

namespace probegi {
namespace {

using namespace test;

constexpr float kPi = 3.14159265f;

class Furnace : public testing::TestWithParam<std::tuple<float, float>> {};

/// Closed box, albedo a, emission Le: E = pi Le / (1 - a) at every point and normal.
TEST_P(Furnace, irradianceIsTheGeometricSeries) {
    const auto [albedo, emission] = GetParam();
    Scene scene;
    addRoom(scene, {-1, 0, -2}, {3, 2.5f, 1}, addMaterial(scene, glm::vec3(albedo), glm::vec3(emission)));
    const ReferenceWorld world(scene);
    const std::vector<FieldQuery> points = {{{0, 0, 0}, {0, 1, 0}, {}},
                                            {{0.5f, 1, -1}, glm::normalize(glm::vec3(1, -2, 0.5f)), {}},
                                            {{-1, 2.4f, 0.9f}, {1, 0, 0}, {}}};
    const auto result = world.pathTracer().irradiance(points, 2000);
    ASSERT_TRUE(result);
    for (const ReferenceIrradiance& e : *result) {
        expectNear(e, glm::vec3(kPi * emission / (1 - albedo)));
        expectSharp(e, 0.03f);
    }
}

INSTANTIATE_TEST_SUITE_P(levels, Furnace,
                         testing::Combine(testing::Values(0.0f, 0.5f, 0.9f), testing::Values(1e-3f, 1.0f, 1e3f)));

/// The same, seen by a camera: L = Le / (1 - a) in every pixel, split into the emission and the rest.
TEST(FurnacePicture, everyPixelShowsTheSameRadiance) {
    Scene scene;
    addRoom(scene, {-1, -1, -1}, {1, 1, 1}, addMaterial(scene, glm::vec3(0.5f), glm::vec3(2.0f)));
    const ReferenceWorld world(scene);
    ReferenceDesc desc;
    desc.picture = {
        .camera = lookAt({0.2f, 0.1f, 0.3f}, {-1, -0.5f, -1}), .width = 6, .height = 4, .diffuseOnly = true};
    desc.samplesPerPixel = 256;
    const auto result = world.pathTracer().render(desc);
    ASSERT_TRUE(result) << result.error().message;
    const Picture& picture = result->picture;
    for (std::size_t i = 0; i < picture.color.pixels.size(); ++i) {
        EXPECT_NEAR(picture.color.pixels[i].x, 4.0f, 4 * result->standardError.pixels[i].x);
        EXPECT_FLOAT_EQ(picture.direct.pixels[i].x, 2.0f);
        EXPECT_NEAR(picture.indirect.pixels[i].x, 2.0f, 4 * result->standardError.pixels[i].x);
        EXPECT_NEAR(picture.irradiance.pixels[i].x, 4.0f * kPi, 8 * kPi * result->standardError.pixels[i].x);
    }
}

/// Albedo exactly 1 and no light: every path still ends, without any radiance.
TEST(ClosedRoom, ofAlbedoOneIsBlackAndEnds) {
    Scene scene;
    addRoom(scene, {-1, -1, -1}, {1, 1, 1}, addMaterial(scene, glm::vec3(1.0f)));
    const ReferenceWorld world(scene);
    const auto result = world.pathTracer().irradiance(std::vector<FieldQuery>(1), 64);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->front().mean, glm::vec3(0.0f));
}

class IntegratingSphere : public testing::TestWithParam<float> {};

/// Radius R, albedo a, lamp of power P at the centre: bounced E = P a / (4 pi R^2 (1 - a)). The sphere is exact here.
TEST_P(IntegratingSphere, bouncedIrradiance) {
    const float albedo = GetParam(), radius = 2.0f, power = 50.0f;
    Scene scene;
    addMaterial(scene, glm::vec3(albedo));
    Light lamp;
    lamp.intensity = glm::vec3(power / (4 * kPi));
    scene.lights.push_back(lamp);
    Node node;
    node.light = 0;
    scene.addNode(node);
    auto tracer = std::make_unique<AnalyticTracer>();
    tracer->materials = scene.materials;
    tracer->addSphere(glm::vec3(0), radius, true, 0);
    const ReferenceWorld world(scene, 1, std::move(tracer));
    const std::vector<FieldQuery> points = {{{0, -radius, 0}, {0, 1, 0}, {}}, {{radius, 0, 0}, {-1, 0, 0}, {}}};
    const auto result = world.pathTracer().irradiance(points, 2000);
    ASSERT_TRUE(result);
    for (const ReferenceIrradiance& e : *result) {
        expectNear(e, glm::vec3(power * albedo / (4 * kPi * radius * radius * (1 - albedo))));
        if (albedo > 0) expectSharp(e, 0.05f);
    }
}

INSTANTIATE_TEST_SUITE_P(albedos, IntegratingSphere, testing::Values(0.0f, 0.5f, 0.9f));

/// The built-in scenes, as Embree's triangles.
TEST(BuiltinScenes, furnaceAndSphereAreWhatTheyClaim) {
    const BuiltinParams params{.albedo = 0.7f, .emission = 3.0f, .power = 80.0f, .radius = 1.5f};
    const ReferenceWorld furnace(*makeBuiltinScene("furnace", params)), sphere(*makeBuiltinScene("sphere", params));
    const FieldQuery middle{furnace.pose.bounds.centre(), {0, 1, 0}, {}};
    const auto inFurnace = furnace.pathTracer().irradiance({&middle, 1}, 4000);
    ASSERT_TRUE(inFurnace);
    expectNear(inFurnace->front(), glm::vec3(kPi * 3.0f / 0.3f));

    const FieldQuery inSphere{{0.0f, 0.3f, 0.2f}, {1, 0, 0}, {}};
    const auto bounced = sphere.pathTracer().irradiance({&inSphere, 1}, 4000);
    ASSERT_TRUE(bounced);
    const float truth = 80.0f * 0.7f / (4 * kPi * 1.5f * 1.5f * 0.3f);
    // Facets change the sphere's light by a thousandth.
    EXPECT_NEAR(bounced->front().mean.x, truth, 3 * bounced->front().standardError.x + 1e-3f * truth);
}

}  // namespace
}  // namespace probegi
