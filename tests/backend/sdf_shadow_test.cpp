// Fields that are looked up past primitives (LeakGuard::sdfShadow), on every backend.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "backend/every_backend.h"
#include "probegi/sdf.h"
#include "probegi/shapes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;

SdfPrimitive solid(SdfShape shape, glm::vec3 centre, glm::vec3 halfSize) {
    SdfPrimitive primitive;
    primitive.shape = shape;
    primitive.centre = centre;
    primitive.halfSize = halfSize;
    return primitive;
}

/// The grid of smallDesc() with one solid of each shape in it.
class BackendSdfShadow : public EveryBackend {
protected:
    BackendSdfShadow() {
        const VolumeDesc grid = smallDesc().volumes[0];
        const glm::vec3 size = glm::vec3(grid.counts - 1) * grid.spacing;
        const auto at = [&](float x, float y, float z) { return grid.origin + size * glm::vec3(x, y, z); };
        sdf.primitives = {solid(SdfShape::box, at(0.5f, 0.5f, 0.5f), {0.01f, 9, 9}),
                          solid(SdfShape::box, at(0.2f, 0.3f, 0.3f), {0.2f, 0.05f, 0.4f}),
                          solid(SdfShape::sphere, at(0.8f, 0.7f, 0.2f), glm::vec3(0.3f)),
                          solid(SdfShape::capsule, at(0.7f, 0.2f, 0.7f), {0.1f, 0.3f, 1}),
                          solid(SdfShape::cylinder, at(0.3f, 0.7f, 0.8f), {0.15f, 0.25f, 1}),
                          solid(SdfShape::roundedBox, at(0.9f, 0.4f, 0.5f), {0.1f, 0.2f, 0.3f}),
                          solid(SdfShape::plane, at(0.5f, 0.05f, 0.5f), glm::vec3(1))};
        sdf.primitives[1].rotation = glm::quat(0.8f, 0.0f, 0.6f, 0.0f);
        sdf.primitives[5].rounding = 0.05f;
    }
    std::shared_ptr<const SdfBlockers> placed() const {
        const Scene scene;
        return made(placeSdf(sdf, scene, poseAt(scene)));
    }
    FieldSetup shadowed() const {
        FieldSetup setup = smallDesc();
        setup.guard = LeakGuard::sdfShadow;
        setup.blockers = placed();
        return setup;
    }

    SdfScene sdf;
};
PROBEGI_ON_EVERY_BACKEND(BackendSdfShadow);

int differing(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i].x - b[i].x) > 0.01f * b[i].x ? 1 : 0;
    return count;
}

TEST_P(BackendSdfShadow, constantFieldIsConstantEverywhere) {
    const FieldSetup setup = shadowed();
    Field field = makeField(setup);
    ASSERT_TRUE(field.update(constantData(setup, {1, 32, 0}, 0.4f)));
    for (const glm::vec3& e : ask(field, randomQueries(2000))) {
        EXPECT_NEAR(e.x, kPi * 1, 1e-3f);
        EXPECT_NEAR(e.y, kPi * 32, 3e-2f);
    }
}

TEST_P(BackendSdfShadow, answersAreTheCpus) {
    const FieldSetup setup = shadowed();
    Field field = makeField(setup), reference = made(kCpu.makeField(context, setup));
    const auto data = randomData(setup, 7);
    ASSERT_TRUE(field.update(data));
    ASSERT_TRUE(reference.update(data));
    const auto queries = randomQueries(4000);
    const auto want = ask(reference, queries);
    // By which of two faces that are as near a point leaves a solid is up to rounding.
    EXPECT_LE(differing(ask(field, queries), want), int(queries.size()) / 200);
    changeSettings(field, [](FieldSettings& s) { s.guard = LeakGuard::moments; });
    EXPECT_GT(differing(ask(field, queries), want), int(queries.size()) / 4) << "the primitives decide";
}

TEST_P(BackendSdfShadow, primitivesMayMoveBetweenQueries) {
    FieldSetup setup = shadowed();
    Field field = makeField(setup), reference = made(kCpu.makeField(context, setup));
    const auto data = randomData(setup, 7);
    ASSERT_TRUE(field.update(data));
    ASSERT_TRUE(reference.update(data));
    const auto queries = randomQueries(2000);
    const auto before = ask(field, queries);
    sdf.primitives[0].centre.x += 0.4f;
    sdf.primitives.push_back(sdf.primitives[0]);
    sdf.primitives.back().centre.x -= 0.9f;
    for (Field* each : {&field, &reference}) changeSettings(*each, [&](FieldSettings& s) { s.blockers = placed(); });
    EXPECT_LE(differing(ask(field, queries), ask(reference, queries)), int(queries.size()) / 200);
    EXPECT_GT(differing(ask(field, queries), before), int(queries.size()) / 10);
    sdf.primitives.clear();
    for (Field* each : {&field, &reference}) changeSettings(*each, [&](FieldSettings& s) { s.blockers = placed(); });
    EXPECT_EQ(differing(ask(field, queries), ask(reference, queries)), 0);
    changeSettings(reference, [&](FieldSettings& s) { s.guard = LeakGuard::none; });
    changeSettings(field, [&](FieldSettings& s) { s.guard = LeakGuard::none; });
    EXPECT_EQ(differing(ask(field, queries), ask(reference, queries)), 0);
}

TEST_P(BackendSdfShadow, needsPrimitives) {
    FieldSetup setup = shadowed();
    setup.blockers = nullptr;
    const auto field = GetParam().makeField(context, setup);
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().code, ErrorCode::invalidArgument);
    EXPECT_THAT(field.error().message, testing::HasSubstr("FieldSettings::blockers"));
}

/// Two rooms of 2 x 2 x 2 m with a wall between, 2 cm thick, in a volume of 1 m spacing: one has a lamp.
TEST_P(BackendSdfShadow, aDarkRoomStaysDark) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].baseColor = glm::vec4(0.7f);
    scene.materials[1].emission = glm::vec3(10);
    Primitive walls, lamp;
    addBox(walls, {-0.2f, -0.2f, -0.2f}, {4.22f, 0, 2.2f});
    addBox(walls, {-0.2f, 2, -0.2f}, {4.22f, 2.2f, 2.2f});
    addBox(walls, {-0.2f, 0, -0.2f}, {4.22f, 2, 0});
    addBox(walls, {-0.2f, 0, 2}, {4.22f, 2, 2.2f});
    addBox(walls, {-0.2f, 0, 0}, {0, 2, 2});
    addBox(walls, {4.02f, 0, 0}, {4.22f, 2, 2});
    addBox(walls, {2, 0, 0}, {2.02f, 2, 2});
    lamp.material = 1;
    addQuad(lamp, {0.5f, 1.9f, 0.5f}, {1, 0, 0}, {0, 0, 1});
    addObject(scene, std::move(walls));
    addObject(scene, std::move(lamp));
    sdf.primitives.clear();
    for (const auto& [lower, upper] :
         std::initializer_list<std::pair<glm::vec3, glm::vec3>>{{{-0.2f, -0.2f, -0.2f}, {4.22f, 0, 2.2f}},
                                                                {{-0.2f, 2, -0.2f}, {4.22f, 2.2f, 2.2f}},
                                                                {{-0.2f, 0, -0.2f}, {4.22f, 2, 0}},
                                                                {{-0.2f, 0, 2}, {4.22f, 2, 2.2f}},
                                                                {{-0.2f, 0, 0}, {0, 2, 2}},
                                                                {{4.02f, 0, 0}, {4.22f, 2, 2}},
                                                                {{2, 0, 0}, {2.02f, 2, 2}}})
        sdf.primitives.push_back(solid(SdfShape::box, 0.5f * (lower + upper), 0.5f * (upper - lower)));
    FieldSetup setup;
    setup.volumes[0] = {{-0.6f, -0.6f, -0.6f}, glm::vec3(1), {6, 4, 4}};
    setup.raysPerProbe = 96;
    setup.guard = LeakGuard::sdfShadow;
    setup.blockers = placed();
    Field field = makeField(setup);
    const ScenePose pose = poseAt(scene);
    const auto tracer = makeTracer(scene, pose);
    for (int i = 0; i < 8; ++i) ASSERT_TRUE(field.update(*tracer, {}));
    std::vector<FieldQuery> lit, dark;
    for (float z = 0.1f; z < 2; z += 0.2f)
        for (float y = 0.1f; y < 2; y += 0.2f) {
            lit.push_back({{2, y, z}, {-1, 0, 0}, {}});
            dark.push_back({{2.02f, y, z}, {1, 0, 0}, {}});
            dark.push_back({{4.02f, y, z}, {-1, 0, 0}, {}});
            dark.push_back({{2 + y, 0, z}, {0, 1, 0}, {}});
        }
    const auto mean = [&](const std::vector<FieldQuery>& queries) {
        double sum = 0;
        for (const glm::vec3& e : ask(field, queries)) sum += double(e.x);
        return sum / double(queries.size());
    };
    EXPECT_LT(mean(dark), 1e-3 * mean(lit));
    EXPECT_GT(mean(lit), 1);
}

/// A sealed dark room with a corridor of 0.4 m, in a volume of 2 m spacing: no cage around the corridor has a probe
/// that it sees, but of their neighbours some in the room are in sight. All is bright outside.
TEST_P(BackendSdfShadow, aDarkCorridorStaysDark) {
    sdf.primitives.clear();
    const auto wall = [&](glm::vec3 lower, glm::vec3 upper) {
        sdf.primitives.push_back(solid(SdfShape::box, 0.5f * (lower + upper), 0.5f * (upper - lower)));
    };
    for (const float side : {-1.0f, 1.0f}) {
        wall({side * 0.25f - 0.05f, -1, 0}, {side * 0.25f + 0.05f, 1, 5.1f});
        wall({side * 3.45f - 0.05f, -1, -6.1f}, {side * 3.45f + 0.05f, 1, 0.1f});
        wall({side * 1.85f - 1.65f, -1, 0}, {side * 1.85f + 1.65f, 1, 0.1f});
        wall({-3.5f, side * 0.95f - 0.05f, -6.1f}, {3.5f, side * 0.95f + 0.05f, 0.1f});
        wall({-0.3f, side * 0.95f - 0.05f, 0}, {0.3f, side * 0.95f + 0.05f, 5.1f});
    }
    wall({-0.3f, -1, 5}, {0.3f, 1, 5.1f});
    wall({-3.5f, -1, -6.1f}, {3.5f, 1, -6});
    FieldSetup setup;
    setup.volumes[0] = {{-5, -2, -7}, glm::vec3(2), {6, 3, 8}};
    setup.raysPerProbe = 32;
    setup.guard = LeakGuard::sdfShadow;
    setup.blockers = placed();
    Field field = makeField(setup);
    std::vector<RayDatum> rays;
    for (const ProbeTask& task : field.control().tasks()) {
        const glm::vec3 p = glm::abs(task.origin - glm::vec3(0, 0, -3));
        const bool inside = p.x < 3.4f && p.y < 0.9f && p.z < 3;
        rays.insert(rays.end(), std::size_t(setup.raysPerProbe), {glm::vec3(inside ? 0.0f : 1.0f), 1.0f});
    }
    ASSERT_TRUE(field.update(rays));
    std::vector<FieldQuery> queries;
    for (const float side : {-1.0f, 1.0f})
        for (float y = -0.7f; y < 0.75f; y += 0.2f)
            for (float z = 0.2f; z < 0.95f; z += 0.1f)
                for (const glm::vec3 viewer : {glm::vec3(0), glm::vec3(-side, 0, 0)})
                    queries.push_back({{side * 0.2f, y, z}, {-side, 0, 0}, viewer});
    const auto mean = [&] {
        double sum = 0;
        for (const glm::vec3& e : ask(field, queries)) sum += double(e.x);
        return sum / double(queries.size());
    };
    EXPECT_LT(mean(), 1e-3);
    changeSettings(field, [](FieldSettings& s) { s.guard = LeakGuard::none; });
    EXPECT_GT(mean(), 0.5);
}

}  // namespace
}  // namespace probegi::test
