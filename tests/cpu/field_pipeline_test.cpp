#include <gtest/gtest.h>

#include <cmath>

#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

// The complete pipeline, from tracer to atlas, in a small built-in scene.
class FieldPipeline : public testing::Test {
protected:
    Field makeField(const Context& own) const {
        FieldSetup desc;
        desc.volumes = {*placeVolume(pose.bounds, {.counts = {6, 6, 6}})};
        desc.raysPerProbe = 48;
        return *Field::create(own, desc, desc);
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

}  // namespace
}  // namespace probegi
