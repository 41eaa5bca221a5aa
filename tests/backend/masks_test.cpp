// Fields that are looked up through masks, on every backend.
#include <cmath>
#include <random>

#include "backend/every_backend.h"
#include "probegi/masks.h"
#include "probegi/shapes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;

/// The grid of smallDesc() with walls through it, one slanted.
class BackendMasks : public EveryBackend {
protected:
    BackendMasks() {
        scene.materials.resize(2);
        scene.materials[0].baseColor = glm::vec4(0.6f);
        scene.materials[0].doubleSided = true;
        scene.materials[1].emission = glm::vec3(8, 6, 4);
        const VolumeDesc grid = smallDesc().volumes[0];
        const glm::vec3 size = glm::vec3(grid.counts - 1) * grid.spacing, middle = grid.origin + 0.5f * size;
        Primitive walls, lamp;
        addRoom(walls, grid.origin + 0.1f * size, grid.origin + 0.93f * size);
        addQuad(walls, {middle.x, grid.origin.y - 9, grid.origin.z - 9}, {0, 0, 99}, {0, 99, 0});
        addQuad(walls, grid.origin + glm::vec3(0, 0.3f, 0.1f) * size, {size.x, 0, 0},
                {0, 0.4f * size.y, 0.7f * size.z});
        lamp.material = 1;
        addQuad(lamp, grid.origin + glm::vec3(0.2f, 0.9f, 0.4f) * size, {0.1f * size.x, 0, 0}, {0, 0, 0.2f * size.z});
        addObject(scene, std::move(walls));
        addObject(scene, std::move(lamp));
        pose = poseAt(scene);
        embree = made(makeEmbreeTracer(context, scene, pose));
    }
    FieldSetup masked(const MaskDesc& desc) const {
        FieldSetup setup = smallDesc();
        setup.guard = LeakGuard::masks;
        setup.masks = made(bakeMasks(context, *embree, setup, desc));
        return setup;
    }

    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> embree;
};
PROBEGI_ON_EVERY_BACKEND(BackendMasks);

TEST_P(BackendMasks, constantFieldIsConstantEverywhere) {
    const FieldSetup setup = masked({.clusters = 3});
    Field field = makeField(setup);
    ASSERT_TRUE(field.update(constantData(setup, {1, 32, 0}, 0.4f)));
    for (const glm::vec3& e : ask(field, randomQueries(2000))) {
        EXPECT_NEAR(e.x, kPi * 1, 1e-3f);
        EXPECT_NEAR(e.y, kPi * 32, 3e-2f);
    }
}

TEST_P(BackendMasks, answersAreTheCpus) {
    for (const int clusters : {3, 8}) {  // two texels to a word, and one
        const FieldSetup setup = masked({.clusters = clusters, .factor = 5});
        Field field = makeField(setup), reference = made(kCpu.makeField(context, setup));
        const auto data = randomData(setup, 7);
        ASSERT_TRUE(field.update(data));
        ASSERT_TRUE(reference.update(data));
        const auto queries = randomQueries(4000);
        const auto got = ask(field, queries), want = ask(reference, queries);
        // At a wall, rounding decides the side of a point; elsewhere of a weight of 1/120.
        int differ = 0;
        for (std::size_t i = 0; i < queries.size(); ++i)
            differ += std::abs(got[i].x - want[i].x) > 0.01f * want[i].x ? 1 : 0;
        EXPECT_LE(differ, int(queries.size()) / 200) << clusters << " clusters";
        // Masks decide: without them the answers are others.
        changeSettings(field, [](FieldSettings& s) { s.guard = LeakGuard::moments; });
        const auto others = ask(field, queries);
        int changed = 0;
        for (std::size_t i = 0; i < queries.size(); ++i)
            changed += std::abs(others[i].x - want[i].x) > 0.01f * want[i].x ? 1 : 0;
        EXPECT_GT(changed, int(queries.size()) / 4);
        // And back again, with other masks.
        const auto newer = masked({.clusters = clusters, .factor = 3}).masks;
        for (Field* each : {&field, &reference})
            changeSettings(*each, [&](FieldSettings& s) {
                s.guard = LeakGuard::masks;
                s.masks = newer;
            });
        const auto gotNewer = ask(field, queries), wantNewer = ask(reference, queries);
        differ = 0;
        for (std::size_t i = 0; i < queries.size(); ++i)
            differ += std::abs(gotNewer[i].x - wantNewer[i].x) > 0.01f * wantNewer[i].x ? 1 : 0;
        EXPECT_LE(differ, int(queries.size()) / 200) << clusters << " clusters, other masks";
    }
}

TEST_P(BackendMasks, bouncesAreTheCpus) {
    const FieldSetup setup = masked({.clusters = 4});
    Field field = makeField(setup), reference = made(kCpu.makeField(context, setup));
    const auto tracer = makeTracer(scene, pose);
    for (int i = 0; i < 4; ++i) {
        ASSERT_TRUE(field.update(*tracer, {}));
        ASSERT_TRUE(reference.update(*embree, {}));
    }
    const auto queries = randomQueries(1000);
    const auto got = ask(field, queries), want = ask(reference, queries);
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        sum += double(want[i].x);
        difference += double(std::abs(got[i].x - want[i].x));
    }
    EXPECT_GT(sum, 0);
    EXPECT_LT(difference, 0.01 * sum);
}

}  // namespace
}  // namespace probegi::test
