#include <gtest/gtest.h>

#include <cmath>

#include "probegi/builtin_scenes.h"
#include "probegi/field.h"

namespace probegi {
namespace {

// The library's own pipeline, from tracer to atlas, in a small built-in scene.
class FieldPipeline : public testing::Test {
protected:
    Field makeField(const Context& own) const {
        FieldDesc desc;
        desc.grid = *placeGrid(pose.bounds, {.counts = {6, 6, 6}});
        desc.raysPerProbe = 48;
        return *Field::create(own, desc);
    }
    std::unique_ptr<Tracer> makeTracer(const Context& own) const {
        return std::move(*makeEmbreeTracer(own, scene, pose));
    }
    FieldQuery middle() const { return {pose.bounds.centre(), {0, 1, 0}, {0, 1, 0}}; }

    Scene scene = *makeBuiltinScene("cornell");
    ScenePose pose = poseAt(scene);
    Lighting lighting{pose.lights, scene.sky};
    Context context = *Context::create();
};

TEST_F(FieldPipeline, isTheSameBitForBitForAnyNumberOfThreads) {
    std::vector<glm::vec3> answers;
    for (const int threads : {1, 2, 4}) {
        const Context own = *Context::create({.threads = threads});
        const auto tracer = makeTracer(own);
        Field field = makeField(own);
        for (int frame = 0; frame < 4; ++frame) ASSERT_TRUE(field.update(*tracer, lighting));
        answers.push_back(field.irradiance(middle()));
    }
    EXPECT_GT(answers[0].x, 0.0f);
    EXPECT_EQ(answers[0], answers[1]);
    EXPECT_EQ(answers[0], answers[2]);
}

TEST_F(FieldPipeline, timesAddUp) {
    const auto tracer = makeTracer(context);
    Field field = makeField(context);
    const UpdateTimes t = *field.update(*tracer, lighting);
    EXPECT_GT(t.trace, 0.0);
    EXPECT_GT(t.shade, 0.0);
    EXPECT_GT(t.blend, 0.0);
    EXPECT_NEAR(t.trace + t.shade + t.blend, t.total, 0.01 * t.total);
    EXPECT_EQ(field.frame(), 1);
}

TEST_F(FieldPipeline, probesInWallsAreFound) {
    const auto tracer = makeTracer(context);
    Field field = makeField(context);
    ASSERT_TRUE(field.update(*tracer, lighting));
    int inside = 0, open = 0;
    for (int probe = 0; probe < probeCount(field.desc().grid); ++probe) {
        const float share = field.probeBackfaceShare(probe);
        ASSERT_TRUE(share >= 0.0f && share <= 1.0f);
        (share > 0.3f ? inside : open) += 1;
    }
    EXPECT_GT(open, 0);
    EXPECT_GT(inside, 0);
    EXPECT_LT(field.probeBackfaceShare(2 + 6 * (3 + 6 * 2)), 0.05f);  // in the box, above the blocks
}

TEST_F(FieldPipeline, convergeStopsAtItsToleranceAndReportsEachUpdate) {
    const auto tracer = makeTracer(context);
    Field field = makeField(context);
    int reported = 0;
    const auto loose = field.converge(*tracer, lighting, 0.5f, 64, [&](const UpdateTimes&) { ++reported; });
    ASSERT_TRUE(loose);
    EXPECT_LT(*loose, 64);
    EXPECT_EQ(reported, *loose);
    EXPECT_EQ(*field.converge(*tracer, lighting, 1e-7f, 20), 20);
    EXPECT_FALSE(field.converge(*tracer, lighting, 0.0f));
    EXPECT_FALSE(field.converge(*tracer, lighting, NAN));
    EXPECT_FALSE(field.converge(*tracer, lighting, 0.1f, 0));
}

TEST_F(FieldPipeline, convergeCanBeCancelled) {
    const Context stopping = *Context::create({.progress = [](const ProgressReport&) { return false; }});
    const auto tracer = makeTracer(stopping);
    Field field = makeField(stopping);
    const auto result = field.converge(*tracer, lighting, 1e-9f, 100000);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

// A sudden change is followed faster when the field is told.
TEST_F(FieldPipeline, eventsSpeedUpTheChange) {
    const auto tracer = makeTracer(context);
    const auto afterSwitchOff = [&](bool tell) {
        FieldDesc desc;
        desc.grid = *placeGrid(pose.bounds, {.counts = {4, 4, 4}});
        desc.raysPerProbe = 32;
        desc.significantChange = desc.newDistribution = 0;
        Field field = *Field::create(context, desc);
        const std::vector<RayDatum> bright(64 * 32, {glm::vec3(1), 1.0f}), dim(64 * 32, {glm::vec3(0.5f), 1.0f});
        EXPECT_TRUE(field.update(bright));
        if (tell) field.notify(FieldEvent::largeLightChange);
        for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(field.update(dim));
        return field.irradiance(middle()).x;
    };
    const float told = afterSwitchOff(true), untold = afterSwitchOff(false);
    EXPECT_NEAR(told, 0.5f * 3.14159f, 0.1f);
    EXPECT_GT(untold, told + 0.5f);
}

}  // namespace
}  // namespace probegi
