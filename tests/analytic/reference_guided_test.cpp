// The closed forms of reference_furnace_test and reference_sky_test once more, with a field that guides the paths.
#include <gtest/gtest.h>

#include "probegi/builtin_scenes.h"
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

/// A sunlit patch seen from a dark room: the case that guides are for. The truth is the unguided estimate; the guided
/// one has less than half of its variance (measured: see docs/accuracy.md).
TEST(GuidedClosedForm, isSharperWhereASmallPatchIsLit) {
    const ReferenceWorld world(std::move(*makeBuiltinScene("two-rooms")));
    const Field field = guideOver(world, *placeGrid(world.pose.bounds, {.targetProbes = 512}));
    const Bounds b = world.pose.bounds;
    const glm::vec3 middle = 0.5f * (b.lower + b.upper);
    const std::vector<FieldQuery> points = {{{middle.x - 1, middle.y, middle.z}, {0, -1, 0}, {}}};
    const auto plain = world.pathTracer().irradiance(points, 20000, 1, true);
    const auto guided = world.pathTracer().irradiance(points, 20000, 2, true, &field);
    ASSERT_TRUE(plain && guided);
    const float both = glm::length(glm::vec2((*guided)[0].standardError.x, (*plain)[0].standardError.x));
    EXPECT_NEAR((*guided)[0].mean.x, (*plain)[0].mean.x, 3 * both);
    RecordProperty("plain", std::to_string((*plain)[0].standardError.x));
    printf("plain %g +- %g guided %g +- %g\n", (*plain)[0].mean.x, (*plain)[0].standardError.x, (*guided)[0].mean.x,
           (*guided)[0].standardError.x);
}

}  // namespace
}  // namespace probegi
