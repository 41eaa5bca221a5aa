// Field::converge against closed forms in cases where it once stopped early: many bounces, and dim rooms beside bright
// ones.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "analytic/field_scene.h"

namespace probegi {
namespace {

constexpr float kPi = 3.14159265f;

// Closed box of albedo a and emission Le: E = pi Le / (1 - a) at every point and normal.
TEST(FieldConverge, furnacesHaveTheirClosedForm) {
    // A hundred bounces multiply noise by a hundred: at albedo 0.99 seeds differ by 2 %.
    for (const auto& [albedo, bound] :
         {std::pair{0.5f, 0.01}, {0.8f, 0.01}, {0.9f, 0.01}, {0.95f, 0.01}, {0.99f, 0.03}}) {
        test::FieldScene s("furnace", {.albedo = albedo}, {.counts = {6, 6, 6}}, FieldDesc{.raysPerProbe = 64});
        const auto done = s.field.converge(*s.tracer, s.lighting, 0.01f, 128);
        ASSERT_TRUE(done);
        EXPECT_TRUE(done->converged) << albedo;
        EXPECT_LT(done->remaining, 0.01f);
        EXPECT_LE(done->updates, 40) << albedo;
        const double expected = double(kPi) * BuiltinParams{}.emission / (1 - double(albedo));
        for (const FieldQuery& q : s.surfaceQueries(200))
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.field.irradiance(q)[c] / expected, 1.0, bound) << albedo;
    }
}

// Two closed boxes side by side, the second a thousand times dimmer and with four times the bounces.
Scene twoFurnaces(const BuiltinParams& bright, const BuiltinParams& dim, float distance) {
    Scene scene = *makeBuiltinScene("furnace", bright);
    const Scene other = *makeBuiltinScene("furnace", dim);
    const int materials = int(scene.materials.size()), meshes = int(scene.meshes.size());
    scene.materials.insert(scene.materials.end(), other.materials.begin(), other.materials.end());
    for (Mesh mesh : other.meshes) {
        for (Primitive& primitive : mesh.primitives) primitive.material += materials;
        scene.meshes.push_back(std::move(mesh));
    }
    for (Node node : other.nodes) {
        if (node.mesh < 0) continue;
        node.mesh += meshes;
        node.translation.x += distance;
        scene.addNode(std::move(node));
    }
    return scene;
}

TEST(FieldConverge, aDarkRoomBesideABrightOneHasItsClosedForm) {
    const BuiltinParams bright{.albedo = 0.5f, .emission = 10}, dim{.albedo = 0.9f, .emission = 0.01f};
    constexpr float kDistance = 8;
    // The outermost probes of each box are half a metre from its walls; those between the boxes see backs only.
    const VolumeDesc grid{{-1.5f, 0.5f, -1.5f}, glm::vec3(1), {12, 3, 4}};
    test::FieldScene s(twoFurnaces(bright, dim, kDistance), grid, FieldDesc{.raysPerProbe = 64});
    const auto done = s.field.converge(*s.tracer, s.lighting, 0.01f, 128);
    ASSERT_TRUE(done);
    EXPECT_TRUE(done->converged);
    EXPECT_LE(done->updates, 64);
    for (const auto& [centre, params] : {std::pair(0.0f, bright), std::pair(kDistance, dim)}) {
        const double expected = double(kPi) * params.emission / (1 - double(params.albedo));
        for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1)})
            for (const glm::vec3 at : {glm::vec3(0, 1.5f, 0), glm::vec3(1.2f, 0.9f, -0.7f)}) {
                const FieldQuery q{at + glm::vec3(centre, 0, 0), n, n};
                EXPECT_NEAR(s.field.irradiance(q).x / expected, 1.0, 0.01) << centre;
            }
    }
}

// A lamp that few rays hit stays noisy for long, so the cap is reached, which must be reported.
TEST(FieldConverge, reachingTheCapIsReported) {
    test::FieldScene s("cornell", {}, {.counts = {6, 6, 6}}, FieldDesc{.raysPerProbe = 16});
    int reported = 0;
    const auto done = s.field.converge(*s.tracer, s.lighting, 1e-3f, 24, [&](const UpdateTimes&) { ++reported; });
    ASSERT_TRUE(done);
    EXPECT_FALSE(done->converged);
    EXPECT_EQ(done->updates, 24);
    EXPECT_EQ(reported, 24);
    EXPECT_GT(done->remaining, 1e-3f);
}

// Earlier light, brighter or darker, is forgotten.
TEST(FieldConverge, forgetsOlderLight) {
    for (const float before : {1e-3f, 1e3f}) {
        test::FieldScene old("furnace", {.albedo = 0.8f, .emission = before}, {.counts = {4, 4, 4}},
                             FieldDesc{.raysPerProbe = 64});
        test::FieldScene s("furnace", {.albedo = 0.8f}, {.counts = {4, 4, 4}}, FieldDesc{.raysPerProbe = 64});
        ASSERT_TRUE(old.field.converge(*old.tracer, old.lighting));
        const auto done = old.field.converge(*s.tracer, s.lighting, 0.01f, 128);
        ASSERT_TRUE(done);
        EXPECT_TRUE(done->converged) << before;
        const double expected = double(kPi) * BuiltinParams{}.emission / 0.2;
        for (const FieldQuery& q : s.surfaceQueries(50))
            EXPECT_NEAR(old.field.irradiance(q).x / expected, 1.0, 0.01) << before;
    }
}

}  // namespace
}  // namespace probegi
