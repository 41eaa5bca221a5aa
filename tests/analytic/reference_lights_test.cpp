// One light, one surface, one formula.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/irradiance_estimate.h"
#include "support/reference_world.h"

namespace probegi {
namespace {

using namespace test;

constexpr float kPi = 3.14159265f;

/// E below the corner of a parallel a x b rectangle at height h, over pi L: Howell, "A Catalog of Radiation Heat
/// Transfer Configuration Factors", B-3.
double cornerFactor(double a, double b, double h) {
    const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * double(kPi));
}

/// A lamp of 2 x 1 that faces down, with a corner 1.5 above the origin.
Scene cornerLamp(glm::vec3 emission, bool doubleSided = false) {
    Scene scene;
    addQuad(scene, {0, 1.5f, 0}, {2, 0, 0}, {0, 0, 1}, addMaterial(scene, glm::vec3(0.0f), emission, doubleSided));
    return scene;
}

TEST(RectangularEmitter, irradianceBelowItsCorner) {
    const glm::vec3 emission(10, 5, 1);
    const ReferenceWorld world(cornerLamp(emission));
    const auto e = world.pathTracer().irradiance(std::vector<FieldQuery>(1), 20000);
    ASSERT_TRUE(e);
    expectNear(e->front(), emission * kPi * float(cornerFactor(2, 1, 1.5)));
    expectSharp(e->front(), 0.01f);
}

TEST(RectangularEmitter, everyStrategyHasTheSameMean) {
    const ReferenceWorld world(cornerLamp(glm::vec3(3.0f)));
    for (const Strategy strategy : {Strategy::both, Strategy::bsdfOnly, Strategy::lightsOnly}) {
        const auto e = estimateIrradiance(world.context, world.transport(), {true, 0, strategy},
                                          std::vector<FieldQuery>(1), 20000, 7);
        ASSERT_TRUE(e);
        expectNear(e->front(), glm::vec3(3.0f * kPi * float(cornerFactor(2, 1, 1.5))));
    }
}

TEST(RectangularEmitter, shinesFromItsFrontOnlyUnlessDoubleSided) {
    const FieldQuery above{{0, 3.0f, 0}, {0, -1, 0}, {}};
    const ReferenceWorld single(cornerLamp(glm::vec3(1.0f))), twin(cornerLamp(glm::vec3(1.0f), true));
    EXPECT_EQ(single.pathTracer().irradiance({&above, 1}, 2000)->front().mean, glm::vec3(0.0f));
    expectNear(twin.pathTracer().irradiance({&above, 1}, 5000)->front(),
               glm::vec3(kPi * float(cornerFactor(2, 1, 1.5))));
}

/// A mirrored, scaled instance: the front remains the front, and the density follows the area in world space.
TEST(RectangularEmitter, instanceThatMirrorsAndScales) {
    Scene scene;
    addQuad(scene, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, addMaterial(scene, glm::vec3(0.0f), glm::vec3(1.0f)));
    scene.nodes[0].translation = {0, 1.5f, 0};
    scene.nodes[0].scale = {2, -1, 1};
    const ReferenceWorld world(scene);
    expectNear(world.pathTracer().irradiance(std::vector<FieldQuery>(1), 10000)->front(),
               glm::vec3(kPi * float(cornerFactor(2, 1, 1.5))));
}

/// Left half black, right half white; nearest texels, so that the edge is sharp.
TEST(TexturedEmitter, onlyItsBrightHalfShines) {
    Scene scene = cornerLamp(glm::vec3(4.0f));
    TextureImage image{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}, "halves"};
    scene.images.push_back(image);
    scene.materials[0].emissiveTexture.image = 0;
    scene.materials[0].emissiveTexture.nearest = true;
    const ReferenceWorld world(scene);
    const glm::vec3 truth(4.0f * kPi * float(cornerFactor(2, 1, 1.5) - cornerFactor(1, 1, 1.5)));
    for (const Strategy strategy : {Strategy::both, Strategy::bsdfOnly, Strategy::lightsOnly}) {
        const auto e = estimateIrradiance(world.context, world.transport(), {true, 0, strategy},
                                          std::vector<FieldQuery>(1), 20000, 3);
        ASSERT_TRUE(e);
        expectNear(e->front(), truth);
    }
}

/// Two lamps of different power: neither density may depend on which triangle was hit.
TEST(TwoEmitters, addUp) {
    Scene scene = cornerLamp(glm::vec3(8.0f));
    addQuad(scene, {-2, 1.5f, 0}, {2, 0, 0}, {0, 0, 1}, addMaterial(scene, glm::vec3(0.0f), glm::vec3(0.5f)));
    const ReferenceWorld world(scene);
    expectNear(world.pathTracer().irradiance(std::vector<FieldQuery>(1), 20000)->front(),
               glm::vec3(8.5f * kPi * float(cornerFactor(2, 1, 1.5))));
}

/// The centre pixel's direct radiance on a floor of albedo 0.8 below a light.
glm::vec3 directOnFloor(Light light, Node node, glm::vec3 floorPoint) {
    Scene scene;
    addQuad(scene, {-10, 0, -10}, {0, 0, 20}, {20, 0, 0}, addMaterial(scene, glm::vec3(0.8f)));
    scene.lights.push_back(light);
    node.light = 0;
    scene.addNode(node);
    const ReferenceWorld world(scene);
    ReferenceDesc desc;
    desc.picture = {.camera = lookAt(floorPoint + glm::vec3(0, 1e-3f, 0), floorPoint, 0.1f),
                    .width = 1,
                    .height = 1,
                    .diffuseOnly = true};
    desc.samplesPerPixel = 4;
    const auto result = world.pathTracer().render(desc);
    EXPECT_EQ(result->picture.indirect.at(0, 0), glm::vec3(0.0f));
    EXPECT_EQ(result->picture.irradiance.at(0, 0), glm::vec3(0.0f));
    return result->picture.direct.at(0, 0);
}

TEST(PointLight, inverseSquareTimesCosine) {
    Node node;
    node.translation = {0, 2, 0};
    Light light;
    light.intensity = {100, 50, 10};
    const glm::vec3 p(1.5f, 0, 0);  // distance 2.5, cosine 0.8
    const glm::vec3 truth = light.intensity * (0.8f / 6.25f) * 0.8f / kPi;
    const glm::vec3 l = directOnFloor(light, node, p);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(l[c], truth[c], 1e-3f * truth[c]);
}

TEST(PointLight, rangeWindow) {
    Node node;
    node.translation = {0, 2, 0};
    Light light;
    light.range = 4.0f;
    EXPECT_NEAR(directOnFloor(light, node, {0, 0, 0}).x, (1 - 1.0f / 16) / 4 * 0.8f / kPi, 1e-5f);
    light.range = 1.9f;
    EXPECT_EQ(directOnFloor(light, node, {0, 0, 0}).x, 0.0f);
}

TEST(DirectionalLight, cosineOfItsSlant) {
    Node node;
    node.rotation =
        glm::quat(std::cos(-0.5f * kPi / 3), std::sin(-0.5f * kPi / 3), 0, 0);  // -Z turned down by 60 degrees
    Light light;
    light.type = LightType::directional;
    light.intensity = glm::vec3(7.0f);
    EXPECT_NEAR(directOnFloor(light, node, {1, 0, 2}).x, 7.0f * std::sin(kPi / 3) * 0.8f / kPi, 1e-4f);
}

TEST(SpotLight, fullInsideTheInnerConeAndNoneOutsideTheOuter) {
    Node node;
    node.translation = {0, 2, 0};
    node.rotation = glm::quat(std::cos(-0.25f * kPi), std::sin(-0.25f * kPi), 0, 0);  // faces down
    Light light;
    light.type = LightType::spot;
    light.innerConeAngle = 0.3f;
    light.outerConeAngle = 0.6f;
    EXPECT_NEAR(directOnFloor(light, node, {0, 0, 0}).x, 0.25f * 0.8f / kPi, 1e-4f);
    EXPECT_EQ(directOnFloor(light, node, {2, 0, 0}).x, 0.0f);
    const float angle = 0.45f, cosine = std::cos(angle);
    const float ramp = (cosine - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
    EXPECT_NEAR(directOnFloor(light, node, {2 * std::tan(angle), 0, 0}).x,
                ramp * ramp * cosine * cosine * cosine * 0.25f * 0.8f / kPi, 1e-4f);
}

/// Twenty lights: one is chosen at a time, and the sum must still be right.
TEST(ManyLights, choosingOneIsUnbiased) {
    Scene scene;
    addQuad(scene, {-10, 0, -10}, {0, 0, 20}, {20, 0, 0}, addMaterial(scene, glm::vec3(0.5f)));
    double truth = 0;
    for (int i = 0; i < 20; ++i) {
        Light light;
        light.intensity = glm::vec3(float(1 + i % 5));
        scene.lights.push_back(light);
        Node node;
        node.translation = {0.3f * float(i - 10), 1.0f + 0.1f * float(i % 3), 0.2f * float(i % 4)};
        node.light = i;
        scene.addNode(node);
        const double square = double(glm::dot(node.translation, node.translation));
        truth += double(light.intensity.x) * double(node.translation.y) / (square * std::sqrt(square));
    }
    const ReferenceWorld world(scene);
    ReferenceDesc desc;
    desc.picture = {.camera = lookAt({0, 1e-3f, 0}, {0, 0, 0}, 0.1f), .width = 1, .height = 1, .diffuseOnly = true};
    desc.samplesPerPixel = 4000;
    const auto result = world.pathTracer().render(desc);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->picture.direct.at(0, 0).x, 0.5 / double(kPi) * truth,
                3 * result->standardError.at(0, 0).x + 1e-3 * truth * 0.5 / double(kPi));
}

}  // namespace
}  // namespace probegi
