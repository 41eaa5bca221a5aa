// An audit reads any backend's field alike.
#include "backend/every_backend.h"
#include "backend/rich_scene.h"
#include "probegi/measure.h"

namespace probegi::test {
namespace {

class BackendLeaks : public EveryBackend {};
PROBEGI_ON_EVERY_BACKEND(BackendLeaks);

// The same rays go into both fields, so that only where they are kept differs.
TEST_P(BackendLeaks, areThoseOfTheCpu) {
    const Scene scene = richScene();
    const ScenePose pose = poseAt(scene);
    const auto tracer = makeEmbreeTracer(context, scene, pose).value();
    FieldSetup setup;
    setup.volumes = {*placeVolume(pose.bounds, {.counts = {5, 4, 4}})};
    setup.raysPerProbe = 48;
    const auto filled = [&](Field field) {
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(field.update(*tracer, {pose.lights, scene.sky}));
        return field;
    };
    const Field field = filled(makeField(setup)), reference = filled(kCpu.makeField(context, setup).value());
    const auto points = surfacePoints(scene, pose, *tracer, 400).value();
    const auto here = leaksAt(context, *tracer, field, points).value();
    const auto there = leaksAt(context, *tracer, reference, points).value();
    int leaking = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(here[i].hidden, there[i].hidden, 1e-3) << i;
        EXPECT_NEAR(here[i].light, there[i].light, 2e-3 * there[i].light + 1e-5) << i;
        EXPECT_NEAR(here[i].leak, there[i].leak, 4e-3) << i;
        leaking += std::abs(there[i].leak) > 0.01;
    }
    EXPECT_GT(leaking, 5) << "else there is nothing to compare";
}

}  // namespace
}  // namespace probegi::test
