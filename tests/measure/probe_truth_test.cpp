#include "probegi/measure.h"

#include <gtest/gtest.h>

#include "probegi/builtin_scenes.h"

namespace probegi {
namespace {

TEST(ProbeTruth, closedFurnaceIsKnown) {
    // E = pi Le / (1 - a) for every normal (closed box of albedo a and emission Le); probes outside see only the backs
    // of the walls, or nothing.
    const auto context = Context::create({.threads = 1});
    const auto scene = makeBuiltinScene("furnace", {.albedo = 0.5f, .emission = 2.0f});
    ASSERT_TRUE(scene) << scene.error().message;
    const ScenePose pose = poseAt(*scene);
    const auto tracer = makeEmbreeTracer(*context, *scene, pose);
    ASSERT_TRUE(tracer);
    const auto pathTracer = PathTracer::create(*context, *scene, pose, **tracer, {});
    ASSERT_TRUE(pathTracer);
    const glm::vec3 size = pose.bounds.size();
    const VolumeDesc grid{pose.bounds.lower - 0.25f * size, size * 0.5f, {4, 4, 4}};
    const auto truth = traceProbeTruth(**tracer, *pathTracer, grid, 64, 256, true);
    ASSERT_TRUE(truth) << truth.error().message;
    EXPECT_EQ(truth->probes.size(), 8u) << "two by two by two stand inside";
    EXPECT_EQ(truth->inWalls + truth->dark, 56);
    EXPECT_GT(truth->noise, 0);
    EXPECT_LT(truth->noise, 0.15);
    for (const ProbeTruth::Probe& probe : truth->probes)
        EXPECT_NEAR(probe.irradiance, 6 * 3.14159265 * 2 / 0.5, 5 * probe.standardError + 1e-3);
}

TEST(ProbeRatios, ofAConstantField) {
    FieldDesc desc;
    desc.raysPerProbe = 16;
    Field field = *Field::create(*Context::create({.threads = 1}), desc);
    ASSERT_TRUE(field.update(std::vector<RayDatum>(8 * 16, {glm::vec3(3.0f), 1.0f})));
    // E = pi L along each of the six axes.
    const double e = 6 * 3.14159265 * 3;
    ProbeTruth truth;
    truth.probes = {{0, e, 0}, {7, 2 * e, 0}};
    const std::vector<double> ratios = probeRatios(*field.read(), truth);
    ASSERT_EQ(ratios.size(), 2u);
    EXPECT_NEAR(ratios[0], 1, 0.01);
    EXPECT_NEAR(ratios[1], 0.5, 0.005);
}

}  // namespace
}  // namespace probegi
