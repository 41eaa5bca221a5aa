// The closed forms of reference_furnace_test and reference_sky_test once more, with a field that guides the paths.
#include <gtest/gtest.h>

#include "support/analytic_tracer.h"
#include "support/reference_world.h"

namespace probegi {
namespace {

using namespace test;

constexpr float kPi = 3.14159265f;

Field guideOver(const ReferenceWorld& world, GridDesc grid) {
    Field field = std::move(*Field::create(world.context, {.grid = grid, .raysPerProbe = 64}));
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(field.update(*world.tracer, world.lighting));
    return field;
}

TEST(GuidedClosedForm, furnace) {
    Scene scene;
    addRoom(scene, {-1, 0, -2}, {3, 2.5f, 1}, addMaterial(scene, glm::vec3(0.5f), glm::vec3(1.0f)));
    const ReferenceWorld world(scene);
    const Field field = guideOver(world, *placeGrid(world.pose.bounds, {.targetProbes = 216}));
    const std::vector<FieldQuery> points = {{{0, 0, 0}, {0, 1, 0}, {}}, {{-1, 2.4f, 0.9f}, {1, 0, 0}, {}}};
    const auto result = world.pathTracer().irradiance(points, 4000, 1, true, &field);
    ASSERT_TRUE(result);
    for (const ReferenceIrradiance& e : *result) expectNear(e, glm::vec3(2 * kPi));
}

/// Every hit is lit by the lamp, so the boxes are in use. E = P a / (4 pi R^2 (1 - a)); the sphere is exact.
TEST(GuidedClosedForm, integratingSphere) {
    const float albedo = 0.5f, radius = 2.0f, power = 50.0f;
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
    const Field field =
        guideOver(world, {.origin = glm::vec3(-3.0f), .spacing = glm::vec3(1.5f), .counts = glm::ivec3(5)});
    const std::vector<FieldQuery> points = {{{0, -radius, 0}, {0, 1, 0}, {}}, {{radius, 0, 0}, {-1, 0, 0}, {}}};
    const auto result = world.pathTracer().irradiance(points, 4000, 1, true, &field);
    ASSERT_TRUE(result);
    for (const ReferenceIrradiance& e : *result)
        expectNear(e, glm::vec3(power * albedo / (4 * kPi * radius * radius * (1 - albedo))));
}

TEST(GuidedClosedForm, openPlaneUnderAConstantSky) {
    Scene scene;
    addQuad(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, addMaterial(scene, glm::vec3(0.5f)));
    scene.sky.radiance = glm::vec3(0.5f, 1, 2);
    const ReferenceWorld world(scene);
    const Field field =
        guideOver(world, {.origin = glm::vec3(-5, -2, -5), .spacing = glm::vec3(2.5f), .counts = {5, 3, 5}});
    const std::vector<FieldQuery> points = {{{0, 0, 0}, {0, 1, 0}, {}}, {{1, 0.5f, 1}, {0, 1, 0}, {}}};
    const auto result = world.pathTracer().irradiance(points, 4000, 1, true, &field);
    ASSERT_TRUE(result);
    for (const ReferenceIrradiance& e : *result) expectNear(e, kPi * scene.sky.radiance);
}

}  // namespace
}  // namespace probegi
