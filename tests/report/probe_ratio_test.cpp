#include "probe_ratio.h"

#include <gtest/gtest.h>

#include "probegi/builtin_scenes.h"

namespace probegi::tool {
namespace {

TEST(Percentiles, byHand) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    const Percentiles p = percentiles(values);
    EXPECT_DOUBLE_EQ(p.low, 5);
    EXPECT_DOUBLE_EQ(p.median, 50);
    EXPECT_DOUBLE_EQ(p.high, 95);
}

TEST(Percentiles, betweenAndFew) {
    EXPECT_DOUBLE_EQ(percentiles({1, 2}).median, 1.5);
    EXPECT_DOUBLE_EQ(percentiles({7}).low, 7);
    EXPECT_DOUBLE_EQ(percentiles({}).median, 0);
}

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
    for (const ProbeTruth::Probe& probe : truth->probes)
        EXPECT_NEAR(probe.irradiance, 6 * 3.14159265 * 2 / 0.5, 5 * probe.standardError + 1e-3);
}

}  // namespace
}  // namespace probegi::tool
