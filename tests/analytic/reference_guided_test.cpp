// The closed forms of reference_furnace_test and reference_sky_test again, with a guide that is made by hand and wrong:
// a learned one would not guide in such scenes and so prove nothing. Each test checks that the guide is used.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/irradiance_estimate.h"
#include "support/analytic_tracer.h"
#include "support/reference_world.h"

namespace probegi {
namespace {

using namespace test;

constexpr float kPi = 3.14159265f;

/// Eight boxes on a ring around the middle, alternately above and below it, in every region. In these scenes no more
/// light comes from there than from elsewhere.
PathGuide wrongGuide(glm::vec3 middle, float radius) {
    PathGuide guide(
        {.origin = middle - glm::vec3(2 * radius), .spacing = glm::vec3(2 * radius), .counts = glm::ivec3(3)});
    PathGuide::Block block{};
    for (int lane = 0; lane < PathGuide::kLanes; ++lane) {
        const float angle = 2 * kPi * float(lane) / float(PathGuide::kLanes);
        const glm::vec3 at = middle + radius * glm::vec3(std::cos(angle), lane % 2 ? 0.6f : -0.4f, std::sin(angle));
        for (int axis = 0; axis < 3; ++axis) {
            block.lower[axis][lane] = at[axis] - 0.2f * radius;
            block.upper[axis][lane] = at[axis] + (0.1f + 0.05f * float(lane)) * radius;
        }
        block.strength[lane] = 1.0f + float(lane);
    }
    for (std::size_t i = 0; i < guide.regionCount(); ++i) guide.setRegion(i, {block}, 0.1f);
    return guide;
}

std::vector<ReferenceIrradiance> estimate(const ReferenceWorld& world, std::span<const FieldQuery> points,
                                          const PathGuide* guide, bool diffuseOnly = true, std::uint64_t seed = 1,
                                          int samples = 8000) {
    const Transport transport = world.transport();
    return *estimateIrradiance(world.context, transport, {.diffuseOnly = diffuseOnly, .guide = guide}, points, samples,
                               seed);
}

void expectGuided(const ReferenceWorld& world, std::span<const FieldQuery> points, const PathGuide& guide,
                  glm::vec3 truth) {
    const auto guided = estimate(world, points, &guide), plain = estimate(world, points, nullptr);
    for (std::size_t i = 0; i < points.size(); ++i) {
        expectNear(guided[i], truth);
        expectSharp(guided[i], 0.05f);
        EXPECT_NE(guided[i].mean, plain[i].mean) << "the guide was not followed";
    }
}

/// The same with wrong expectations of light in its regions: none, far too little or far too much, so that paths end
/// where there is light and continue where there is none.
PathGuide wrongExpectations(glm::vec3 middle, float radius) {
    PathGuide guide = wrongGuide(middle, radius);
    constexpr float kLevels[] = {1.0f, 0.01f, 50.0f, 0.2f, 0.0f};
    for (std::size_t i = 0; i < guide.regionCount(); ++i) guide.setExpected(i, kLevels[i % std::size(kLevels)]);
    return guide;
}

/// Expectations that are wrong by a factor of a thousand increase noise, hence more samples, but not the mean.
void expectUnbiased(const ReferenceWorld& world, std::span<const FieldQuery> points, const PathGuide& guide,
                    glm::vec3 truth) {
    const auto guided = estimate(world, points, &guide, true, 1, 64000);
    for (const ReferenceIrradiance& e : guided) {
        expectNear(e, truth);
        expectSharp(e, 0.1f);
    }
}

TEST(GuidedClosedForm, furnace) {
    Scene scene;
    addRoom(scene, {-1, 0, -2}, {3, 2.5f, 1}, addMaterial(scene, glm::vec3(0.5f), glm::vec3(1.0f)));
    const ReferenceWorld world(scene);
    const std::vector<FieldQuery> points = {{{0, 0, 0}, {0, 1, 0}, {}}, {{-1, 2.4f, 0.9f}, {1, 0, 0}, {}}};
    expectGuided(world, points, wrongGuide({1, 1.25f, -0.5f}, 1.0f), glm::vec3(2 * kPi));
    expectUnbiased(world, points, wrongExpectations({1, 1.25f, -0.5f}, 1.0f), glm::vec3(2 * kPi));
}

/// E = P a / (4 pi R^2 (1 - a)); the sphere is exact.
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
    const std::vector<FieldQuery> points = {{{0, -radius, 0}, {0, 1, 0}, {}}, {{radius, 0, 0}, {-1, 0, 0}, {}}};
    const glm::vec3 truth(power * albedo / (4 * kPi * radius * radius * (1 - albedo)));
    expectGuided(world, points, wrongGuide(glm::vec3(0), 1.2f), truth);
    expectUnbiased(world, points, wrongExpectations(glm::vec3(0), 1.2f), truth);
}

TEST(GuidedClosedForm, openPlaneUnderAConstantSky) {
    Scene scene;
    addQuad(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, addMaterial(scene, glm::vec3(0.5f)));
    scene.sky.radiance = glm::vec3(0.5f, 1, 2);
    const ReferenceWorld world(scene);
    const std::vector<FieldQuery> points = {{{0, 0, 0}, {0, 1, 0}, {}}, {{1, 0.5f, 1}, {0, 1, 0}, {}}};
    expectGuided(world, points, wrongGuide({0, 1, 0}, 2.0f), kPi * scene.sky.radiance);
    expectUnbiased(world, points, wrongExpectations({0, 1, 0}, 2.0f), kPi * scene.sky.radiance);
}

/// Walls from rough coats to near mirrors: the guide replaces the cosine lobe only, and the mean stays the same.
TEST(GuidedClosedForm, glossyWallsKeepTheirMean) {
    for (const float roughness : {0.0f, 0.1f, 0.8f})
        for (const float metallic : {0.0f, 1.0f}) {
            Scene scene;
            const int wall = addMaterial(scene, {0.7f, 0.5f, 0.3f});
            addRoom(scene, {-1, -1, -1}, {1, 1, 1}, wall);
            addQuad(scene, {-0.5f, 0.99f, -0.5f}, {1, 0, 0}, {0, 0, 1},
                    addMaterial(scene, glm::vec3(0.0f), glm::vec3(5.0f)));
            scene.materials[std::size_t(wall)].roughness = roughness;
            scene.materials[std::size_t(wall)].metallic = metallic;
            const ReferenceWorld world(scene);
            const std::vector<FieldQuery> points = {{{0.2f, -1, 0.1f}, {0, 1, 0}, {}}};
            const auto plain = estimate(world, points, nullptr, false);
            for (const PathGuide& guide : {wrongGuide(glm::vec3(0), 0.7f), wrongExpectations(glm::vec3(0), 0.7f)}) {
                const auto guided = estimate(world, points, &guide, false, 2);
                for (int c = 0; c < 3; ++c) {
                    ASSERT_TRUE(std::isfinite(guided[0].mean[c]));
                    EXPECT_NEAR(guided[0].mean[c], plain[0].mean[c],
                                3 * std::hypot(guided[0].standardError[c], plain[0].standardError[c]))
                        << "roughness " << roughness << " metallic " << metallic;
                }
            }
        }
}

}  // namespace
}  // namespace probegi
