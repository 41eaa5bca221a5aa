// Budgets in a scene: probes pause, and wake where they see a change.
#include <gtest/gtest.h>

#include <algorithm>

#include "probegi/builtin_scenes.h"
#include "probegi/field.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

// Two rooms with a closed wall between them, each with a lamp.
class FieldBudget : public testing::Test {
protected:
    FieldBudget() {
        setup.volumes[0] = {{-4.6f, 0.25f, -1.8f}, {0.7f, 0.75f, 0.9f}, {14, 4, 5}};
        setup.raysPerProbe = 64;
        for (const float x : {-2.5f, 2.5f}) {
            PlacedLight lamp;
            lamp.type = LightType::point;
            lamp.position = glm::vec3(x, 1.8f, 0);
            lamp.intensity = glm::vec3(3.0f);
            lighting.lights.push_back(lamp);
        }
        UpdateBudget budget;
        const int each = setup.raysPerProbe + setup.fixedRays + setup.emitterSamples;
        budget.rays = std::int64_t(each) * probeCount(setup) / 2;
        field.emplace(*Field::create(context, setup, setup));
        field->control().setBudget(budget).value();
    }
    // Returns how often each probe was updated.
    std::vector<int> update(int count) {
        std::vector<int> times(std::size_t(probeCount(setup)), 0);
        for (int i = 0; i < count; ++i) {
            for (const ProbeTask& task : field->control().tasks()) ++times[task.slot];
            EXPECT_TRUE(field->update(*tracer, lighting));
        }
        return times;
    }
    // Mean over the probes on one side of the wall between the rooms, at x = 0, and not beside it.
    double meanOf(const std::vector<int>& times, float side) const {
        double sum = 0;
        int count = 0;
        for (int slot = 0; slot < probeCount(setup); ++slot) {
            if (side * field->control().probePosition(slot).x < 1.2f) continue;
            sum += times[std::size_t(slot)];
            ++count;
        }
        return sum / count;
    }

    Context context = *Context::create({.threads = 2});
    Scene scene = *makeBuiltinScene("dark-room");
    ScenePose pose = poseAt(scene);
    Lighting lighting;
    std::unique_ptr<Tracer> tracer = *makeEmbreeTracer(context, scene, pose);
    FieldSetup setup;
    std::optional<Field> field;
};

TEST_F(FieldBudget, probesPauseAndThoseThatSeeAChangeWake) {
    update(110);
    const double before = double(field->control().tasks().size()) / probeCount(setup);
    EXPECT_LT(before, 0.2) << "most have converged; 35 of 280 are those that waited longest";
    lighting.lights[0].intensity *= 3.0f;
    const std::vector<int> times = update(16);
    EXPECT_GT(meanOf(times, -1), 9.0);
    EXPECT_LT(meanOf(times, 1), 4.2) << "the turn of those that waited longest: 16 x 35 updates for 140 probes";
}

}  // namespace
}  // namespace probegi
