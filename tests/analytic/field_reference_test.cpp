#include <gtest/gtest.h>

#include "analytic/field_scene.h"
#include "probegi/io.h"
#include "probegi/measure.h"
#include "support/scenes.h"

namespace probegi {
namespace {

void expectMedianNearOne(const test::FieldScene& s, int probes, int samples, double bound) {
    const PathTracer reference = std::move(*PathTracer::create(s.context, s.scene, s.pose, *s.tracer, s.lighting));
    const auto truth = traceProbeTruth(*s.tracer, reference, s.field.desc().volumes[0], probes, samples, true);
    ASSERT_TRUE(truth) << truth.error().message;
    const std::vector<double> ratios = probeRatios(*s.field.read(), *truth);
    ASSERT_GE(ratios.size(), 20u);
    const double median = percentiles(ratios).median;
    testing::Test::RecordProperty("probes", std::to_string(ratios.size()));
    testing::Test::RecordProperty("median", std::to_string(median));
    EXPECT_NEAR(median, 1.0, bound);
}

TEST(FieldReference, cornellProbesHoldWhatThePathTracerFinds) {
    test::FieldScene s("cornell", {}, {.targetProbes = 1000});
    ASSERT_TRUE(s.field.converge(*s.tracer, s.lighting, 0.005f, 96));
    expectMedianNearOne(s, 1000, 300, 0.025);  // measured 0.979, 343 probes
}

TEST(FieldReference, sponzaProbesHoldWhatThePathTracerFinds) {
    auto loaded = loadScene(test::scenesFolder() / "sponza" / "sponza.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    loaded->scene.sky.radiance = {0.6f, 0.8f, 1.2f};
    const VolumeDesc grid = *placeVolume(poseAt(loaded->scene).bounds, {.targetProbes = 1500});
    test::FieldScene s(std::move(loaded->scene), grid);
    ASSERT_TRUE(s.field.converge(*s.tracer, s.lighting, 0.01f, 48));
    expectMedianNearOne(s, 1000, 150, 0.02);  // measured 0.9997, 828 probes
}

}  // namespace
}  // namespace probegi
