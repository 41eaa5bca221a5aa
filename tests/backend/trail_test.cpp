// Things that move leave nothing behind: light where they were, seconds later, is that of a field that never saw them.
#include <glm/ext/matrix_transform.hpp>

#include "backend/every_backend.h"
#include "probegi/builtin_scenes.h"
#include "probegi/edits.h"

namespace probegi::test {
namespace {

class BackendTrail : public EveryBackend {
protected:
    BackendTrail() {
        desc.volumes = {offTheWalls(placeVolume(poseAt(scene).bounds, {.counts = {6, 5, 6}}).value())};
        desc.raysPerProbe = 64;
    }

    /// The pose at the end with the box somewhere else.
    ScenePose poseWithBoxAt(glm::vec3 place) const {
        ScenePose pose = poseAt(scene, 4);
        for (Instance& instance : pose.instances)
            if (scene.nodes[std::size_t(instance.node)].name == "box")
                instance.toWorld = glm::translate(glm::mat4(1.0f), place);
        return pose;
    }
    /// Points on the floor and, above it, in the air where the box passes.
    static std::vector<FieldQuery> onTheWay() {
        std::vector<FieldQuery> points;
        for (int x = -5; x <= 5; ++x)
            for (const float z : {0.2f, 0.6f, 1.0f})
                for (const float y : {0.001f, 0.6f}) points.push_back({{0.24f * float(x), y, z}, {0, 1, 0}});
        return points;
    }
    /// Light there after `updates` with the box at its last place; before, it passed slowly, or was there all along.
    std::vector<glm::vec3> lightAfter(bool passed, int updates, bool told) const {
        const auto backend = made(GetParam().open(context));
        const Lighting lighting{poseAt(scene, 4).lights, scene.sky};
        const auto tracer = made(backend->openMovableScene(scene, poseWithBoxAt(last)));
        Field field = made(backend->makeField(desc, desc));
        std::optional<SceneWatch> watch;
        const auto to = [&](glm::vec3 place, int count) {
            const ScenePose pose = poseWithBoxAt(place);
            ASSERT_TRUE(tracer->setPose(pose));
            if (!watch) watch.emplace(scene, pose, lighting);
            if (told) notify(field.control(), made(watch->edits(pose, lighting, *tracer)));
            for (int i = 0; i < count; ++i) ASSERT_TRUE(field.update(*tracer, lighting));
        };
        to(passed ? glm::vec3(-1.2f, 0, 0.6f) : last, 40);
        for (int step = 1; step <= 10; ++step)
            to(passed ? glm::mix(glm::vec3(-1.2f, 0, 0.6f), last, 0.1f * float(step)) : last, 2);
        to(last, updates);
        return ask(field, onTheWay());
    }

    const Scene scene = makeBuiltinScene("moving").value();
    const glm::vec3 last{1.2f, 0, -1.4f};  // in the far corner, off the points
    FieldSetup desc;
};
PROBEGI_ON_EVERY_BACKEND(BackendTrail);

struct Worst {
    double darkest = 1, brightest = 1, mean = 1;
};

Worst ratios(const std::vector<glm::vec3>& light, const std::vector<glm::vec3>& truth) {
    Worst worst;
    double sum = 0, trueSum = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const double e = double(light[i].x) + light[i].y + light[i].z, t = double(truth[i].x) + truth[i].y + truth[i].z;
        worst.darkest = std::min(worst.darkest, e / t);
        worst.brightest = std::max(worst.brightest, e / t);
        sum += e;
        trueSum += t;
    }
    worst.mean = sum / trueSum;
    return worst;
}

TEST_P(BackendTrail, aBoxThatPassedLeavesNone) {
    const std::vector<glm::vec3> never = lightAfter(false, 30, true);
    const Worst soon = ratios(lightAfter(true, 0, true), never), later = ratios(lightAfter(true, 30, true), never);
    // Measured on every backend: 0.915 to 1.000, 0.945 on average at once; 0.974 to 1.000, 0.980 after 30 updates.
    EXPECT_GT(soon.darkest, 0.85);
    EXPECT_LT(soon.brightest, 1.05);
    EXPECT_GT(later.darkest, 0.95);
    EXPECT_LT(later.brightest, 1.03);
    EXPECT_NEAR(later.mean, 1, 0.03);
}

}  // namespace
}  // namespace probegi::test
