#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "analytic/field_scene.h"

namespace probegi {
namespace {

constexpr float kPi = 3.14159265f;

// A large slab with its top at y = 0. Tests add lights.
Scene slabScene(glm::vec3 skyRadiance) {
    Scene scene;
    scene.materials.push_back({.name = "slab", .baseColor = {0.5f, 0.5f, 0.5f, 1}});
    Primitive p;
    const float r = 200;
    for (const float y : {0.0f, -1.0f})
        for (const glm::vec2 c : {glm::vec2(-r, -r), {-r, r}, {r, r}, {r, -r}}) p.positions.push_back({c.x, y, c.y});
    p.indices = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6};  // top seen from above, bottom from below
    scene.meshes.push_back({"slab", {p}});
    scene.addNode({.name = "slab", .mesh = 0});
    scene.sky.radiance = skyRadiance;
    return scene;
}

// Open plane under a constant sky L: E(up) = pi L.
TEST(FieldLight, openPlaneSeesTheWholeSky) {
    test::FieldScene s(slabScene({0.5f, 1, 2}), {{-2.1f, -0.7f, -2.1f}, glm::vec3(1.4f), {4, 3, 4}});
    s.run(100);
    for (const glm::vec2 at : {glm::vec2(0), glm::vec2(0.4f, -0.6f), glm::vec2(-1.1f, 0.9f)}) {
        const glm::vec3 e = s.field.irradiance({{at.x, 0, at.y}, {0, 1, 0}, {0, 1, 0}});
        EXPECT_NEAR(e.x, kPi * 0.5f, 0.01f * kPi * 0.5f);
        EXPECT_NEAR(e.y, kPi * 1, 0.01f * kPi);
        EXPECT_NEAR(e.z, kPi * 2, 0.01f * kPi * 2);
    }
}

// Integrating sphere of radius R and albedo a with a point light of power P: indirect E = P a / (4 pi R^2 (1 - a)).
TEST(FieldLight, integratingSphere) {
    for (const float albedo : {0.3f, 0.5f, 0.8f}) {
        const BuiltinParams params{.albedo = albedo, .power = 50, .radius = 1.5f};
        test::FieldScene s("sphere", params, {.counts = {8, 8, 8}}, test::FieldSetup({}, {.hysteresis = 0.9f}));
        s.run(int(50 / (1 - albedo)));
        const double expected = 50 * albedo / (4 * kPi * 1.5 * 1.5 * (1 - albedo));
        double mean = 0;
        const auto queries = s.surfaceQueries(300);
        for (const FieldQuery& q : queries) {
            const double ratio = s.field.irradiance(q).y / expected;
            EXPECT_NEAR(ratio, 1.0, 0.02) << albedo;
            mean += ratio / double(queries.size());
        }
        EXPECT_NEAR(mean, 1.0, 0.01) << albedo;
    }
}

// A point under the slab gets none of the light on its top.
TEST(FieldLight, underThePlaneIsBlackWhereOnlyTheTopIsLit) {
    Scene scene = slabScene(glm::vec3(0));
    scene.lights.push_back({.type = LightType::directional, .intensity = glm::vec3(10)});
    scene.addNode({.name = "sun", .rotation = glm::quat(0.70710678f, -0.70710678f, 0, 0), .light = 0});
    test::FieldScene s(std::move(scene), {{-2, -4.3f, -2}, glm::vec3(1), {5, 8, 5}});
    s.run(40);
    const glm::vec3 above = s.field.irradiance({{0.3f, 2, 0.2f}, {0, -1, 0}, {0, -1, 0}});
    EXPECT_NEAR(above.x, 0.5f * 10, 0.05f * 5);  // E from a plane of radiosity 5: all of it
    const glm::vec3 below = s.field.irradiance({{0.3f, -1, 0.2f}, {0, -1, 0}, {0, -1, 0}});
    EXPECT_LT(below.x, 0.01f * above.x);
}

}  // namespace
}  // namespace probegi
