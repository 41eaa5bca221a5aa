// The whole CPU pipeline on an engine's own job system.
#include <gtest/gtest.h>

#include "probegi/probegi.h"
#include "support/field_setup.h"
#include "support/jobs.h"

namespace probegi::test {
namespace {

struct Outcome {
    std::vector<glm::vec3> irradiance, picture, truth;
    bool operator==(const Outcome&) const = default;
};

Outcome outcomeOn(const Context& context) {
    const Scene scene = makeBuiltinScene("cornell").value();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = makeEmbreeTracer(context, scene, pose).value();
    FieldSetup desc;
    desc.raysPerProbe = 32;
    desc.volumes = {placeVolume(pose.bounds, {.targetProbes = 200}).value()};
    Field field = Field::create(context, desc, desc).value();
    for (int i = 0; i < 3; ++i) field.update(*tracer, lighting).value();
    std::vector<FieldQuery> queries;
    for (int i = 0; i < 5000; ++i)
        queries.push_back({.position = probePosition(desc.volumes[0], i % 200) + 0.01f * float(i % 7)});
    Outcome outcome;
    outcome.irradiance.resize(queries.size());
    field.irradiance(queries, outcome.irradiance).value();
    PictureDesc picture{.camera = pose.cameras.at(0), .width = 96, .height = 64};
    outcome.picture = renderPicture(context, *tracer, lighting, &field, picture).value().picture.color.pixels;
    picture.width = 24;
    picture.height = 16;
    const auto reference = PathTracer::create(context, scene, pose, *tracer, lighting).value();
    outcome.truth = reference.render({.picture = picture, .samplesPerPixel = 4}).value().picture.color.pixels;
    return outcome;
}

// The same bits as with the library's own threads, and no nested loops.
TEST(EngineJobs, GiveTheSameBits) {
    Jobs jobs;
    const Outcome own = outcomeOn(Context::create({.threads = 2}).value());
    const Outcome engine = outcomeOn(Context::create({.threads = 3, .parallelFor = jobs.callback()}).value());
    EXPECT_GT(own.irradiance[0].x, 0.0f);
    EXPECT_TRUE(own == engine);
    EXPECT_GT(jobs.loops, 10);
    EXPECT_FALSE(jobs.nested);
}

}  // namespace
}  // namespace probegi::test
