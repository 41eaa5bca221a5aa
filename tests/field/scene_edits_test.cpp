#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "field/control_impl.h"
#include "probegi/builtin_scenes.h"
#include "probegi/edits.h"

namespace probegi {
namespace {

/// builtin:door at a moment, and what may be done to it.
struct State {
    State(const Scene& s, float seconds) : scene(&s), pose(poseAt(s, seconds)), lighting{pose.lights, s.sky} {}

    Instance& door() {
        for (Instance& instance : pose.instances)
            if (scene->nodes[std::size_t(instance.node)].name == "door") return instance;
        throw std::logic_error("no door");
    }
    std::unique_ptr<Tracer> trace(const Context& context) const {
        return std::move(makeEmbreeTracer(context, *scene, pose).value());
    }

    const Scene* scene;
    ScenePose pose;
    Lighting lighting;
};

class SceneEdits : public testing::Test {
protected:
    SceneEdits() {
        before.lighting.lights = {lamp({-2.5f, 1.4f, 0}), sun()};
        after = before;
    }

    static PlacedLight lamp(glm::vec3 position, float intensity = 10) {
        PlacedLight light;
        light.position = position;
        light.intensity = glm::vec3(intensity);
        return light;
    }
    static PlacedLight sun(glm::vec3 direction = {0, -1, 0}) {
        PlacedLight light;
        light.type = LightType::directional;
        light.direction = glm::normalize(direction);
        light.intensity = glm::vec3(3);
        return light;
    }
    std::vector<SceneEdit> find(const State& a, const State& b) const {
        auto found = findEdits(scene, a.pose, a.lighting, b.pose, b.lighting, *b.trace(context));
        return std::move(found.value());
    }
    static bool holds(const Bounds& box, glm::vec3 p) {
        for (int axis = 0; axis < 3; ++axis)
            if (p[axis] < box.lower[axis] || p[axis] > box.upper[axis]) return false;
        return true;
    }

    const Context context = *Context::create({.threads = 1});
    const Scene scene = makeBuiltinScene("door").value();
    State before{scene, 0};
    State after{scene, 0};
    // The rooms are 5 x 2.8 x 5 m each on both sides of x = 0; the first one has a window in its front wall, at z 2.5.
    const glm::vec3 firstRoom{-2.5f, 1, -2}, secondRoom{2.5f, 1, -2}, outside{8, 1, 8};
};

TEST_F(SceneEdits, ofTheSameStateThereAreNone) {
    EXPECT_TRUE(find(before, before).empty());
    std::swap(after.lighting.lights[0], after.lighting.lights[1]);
    EXPECT_TRUE(find(before, after).empty()) << "the order of lights says nothing";
}

// A table of what may happen to lights: the size of the change decides.
TEST_F(SceneEdits, lights) {
    struct Case {
        const char* what;
        std::vector<PlacedLight> lights;
        float size;  ///< 0: no edit
        bool everywhere;
    };
    const PlacedLight l = lamp({-2.5f, 1.4f, 0}), s = sun();
    PlacedLight ranged = l, dimSun = s;
    ranged.range = 2;
    dimSun.intensity *= 0.5f;
    const Case cases[] = {
        {"off", {s}, 1, false},
        {"another one goes on", {l, s, lamp({2, 1, 0})}, 1, false},
        {"twice as bright", {lamp({-2.5f, 1.4f, 0}, 20), s}, 0.5f, false},
        {"ten times", {lamp({-2.5f, 1.4f, 0}, 100), s}, 0.9f, false},
        {"a little brighter", {lamp({-2.5f, 1.4f, 0}, 12), s}, 0, false},
        {"a little moved", {lamp({-2.45f, 1.4f, 0}), s}, 0, false},
        {"moved through the room", {lamp({-4.5f, 1.4f, 0}), s}, 1, false},
        {"a range", {ranged, s}, 1, false},
        {"the sun goes on by an hour", {l, sun({0.3f, -1, 0})}, 0.9716f, true},
        {"the sun goes on by minutes", {l, sun({0.03f, -1, 0})}, 0, true},
        {"half a sun", {l, dimSun}, 0.5f, true},
        {"sunset", {l}, 1, true},
    };
    for (const Case& c : cases) {
        after.lighting.lights = c.lights;
        const auto edits = find(before, after);
        if (c.size == 0) {
            EXPECT_TRUE(edits.empty()) << c.what;
            continue;
        }
        ASSERT_EQ(edits.size(), 1u) << c.what;
        EXPECT_EQ(edits[0].kind, EditKind::light);
        EXPECT_NEAR(edits[0].size, c.size, 1e-3f) << c.what;
        EXPECT_EQ(edits[0].everywhere, c.everywhere) << c.what;
        EXPECT_EQ(edits[0].event, c.size >= 0.8f ? FieldEvent::largeLightChange : FieldEvent::smallLightChange);
    }
}

TEST_F(SceneEdits, skies) {
    const auto withSky = [&](glm::vec3 radiance) {
        after.lighting.sky.radiance = radiance;
        return find(before, after);
    };
    const glm::vec3 sky = before.lighting.sky.radiance;
    EXPECT_TRUE(withSky(1.1f * sky).empty());
    ASSERT_EQ(withSky(2.0f * sky).size(), 1u);
    EXPECT_EQ(withSky(2.0f * sky)[0].event, FieldEvent::smallLightChange);
    EXPECT_EQ(withSky(glm::vec3(0))[0].event, FieldEvent::largeLightChange);
    EXPECT_TRUE(withSky(glm::vec3(0))[0].everywhere);
    after.lighting.sky.radiance = sky;
    after.lighting.sky.image = HdrImage(2, 1, glm::vec3(1));
    ASSERT_EQ(find(before, after).size(), 1u) << "another picture";
    EXPECT_EQ(find(before, after)[0].kind, EditKind::sky);
}

// A lamp in the second room, whose door is shut: its light stays there. The same in the first one goes out by the
// window.
TEST_F(SceneEdits, aLampReachesItsRoom) {
    after.lighting.lights.push_back(lamp({2.5f, 1.4f, 0}));
    auto edits = find(before, after);
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_TRUE(holds(edits[0].region, secondRoom));
    EXPECT_FALSE(holds(edits[0].region, firstRoom));
    EXPECT_GT(edits[0].region.lower.x, -0.06f);
    EXPECT_LT(edits[0].region.upper.y, 2.81f);
    EXPECT_LT(edits[0].region.lower.x, 0.1f) << "up to the wall";
    EXPECT_GT(edits[0].region.upper.x, 4.9f);

    after.lighting.lights.back() = lamp({-2.5f, 1.4f, 0.1f});
    edits = find(before, after);
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_TRUE(holds(edits[0].region, firstRoom));
    EXPECT_GT(edits[0].region.upper.z, 5) << "out by the window";

    after.lighting.lights.back().range = 1;
    const auto ranged = find(before, after);
    ASSERT_EQ(ranged.size(), 1u);
    EXPECT_GE(ranged[0].region.lower.x, -5.1f);
}

// With an open door it reaches both rooms.
TEST_F(SceneEdits, lightGoesThroughAnOpenDoor) {
    before = State(scene, 10);
    after = before;
    after.lighting.lights.push_back(lamp({2.5f, 1.4f, 0}));
    const auto edits = find(before, after);
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_TRUE(holds(edits[0].region, secondRoom));
    EXPECT_LT(edits[0].region.lower.x, -4) << "the first room's far wall";
}

TEST_F(SceneEdits, aSpotReachesWhatItsConeDoes) {
    PlacedLight spot = lamp({2.5f, 2.5f, -2});
    spot.type = LightType::spot;
    spot.direction = {0, -1, 0};
    spot.cosInner = 0.99f;
    spot.cosOuter = 0.98f;
    spot.range = 0.3f;  // ends in the air: no bounce
    after.lighting.lights.push_back(spot);
    const auto edits = find(before, after);
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_LT(edits[0].region.size().x, 0.13f);
    EXPECT_NEAR(edits[0].region.lower.y, 2.2f, 0.02f);
    EXPECT_EQ(edits[0].region.upper.y, 2.5f);
}

TEST_F(SceneEdits, objects) {
    const auto moved = [&](glm::vec3 way) {
        after = before;
        after.door().toWorld = glm::translate(glm::mat4(1.0f), way) * before.door().toWorld;
        return find(before, after);
    };
    EXPECT_TRUE(moved({0.1f, 0, 0}).empty()) << "a 25th of its size";
    const auto far = moved({2, 0, 0});
    ASSERT_EQ(far.size(), 1u);
    EXPECT_EQ(far[0].kind, EditKind::object);
    EXPECT_EQ(far[0].index, before.door().node);
    EXPECT_EQ(far[0].event, FieldEvent::largeObjectChange);
    const auto near = moved({0.4f, 0, 0});
    ASSERT_EQ(near.size(), 1u);
    EXPECT_EQ(near[0].event, FieldEvent::smallObjectChange);
    EXPECT_FALSE(far[0].everywhere);
    EXPECT_NEAR(far[0].size, 2 / glm::length(glm::vec3(0.04f, 2.19f, 1.09f)), 0.01f);
    EXPECT_TRUE(holds(far[0].region, firstRoom)) << "which the door does not hide any more";
    EXPECT_TRUE(holds(far[0].region, secondRoom));

    after = before;
    std::erase_if(after.pose.instances, [&](const Instance& i) { return i.node == before.door().node; });
    for (const auto& [from, to] : {std::pair(&before, &after), std::pair(&after, &before)}) {
        const auto edits = find(*from, *to);
        ASSERT_EQ(edits.size(), 1u);
        EXPECT_EQ(edits[0].size, 1.0f) << "gone, or come";
        EXPECT_TRUE(holds(edits[0].region, {-2.5f, 1, 0})) << "it sees along x";
        EXPECT_TRUE(holds(edits[0].region, {2.5f, 1, 0}));
    }
}

TEST_F(SceneEdits, manyObjectsShareABox) {
    for (Instance& instance : after.pose.instances)
        instance.toWorld = glm::translate(glm::mat4(1.0f), glm::vec3(0, 30, 0)) * instance.toWorld;
    Scene crowd = scene;
    const Instance copy = before.door();
    for (int i = 0; i < 40; ++i) {
        Instance more = copy;
        more.node = crowd.addNode(scene.nodes[std::size_t(copy.node)]);
        before.pose.instances.push_back(more);
    }
    const auto edits =
        findEdits(crowd, before.pose, before.lighting, after.pose, after.lighting, *after.trace(context));
    ASSERT_TRUE(edits);
    EXPECT_FALSE(edits->empty());
    EXPECT_LE(edits->size(), after.pose.instances.size() + 40);
    for (const SceneEdit& edit : *edits) EXPECT_GE(edit.region.upper.y, 0) << edit.index;
}

TEST_F(SceneEdits, areTheSameEveryTime) {
    after.lighting.lights[0] = lamp({-1, 1, 0});
    after.door().toWorld = glm::mat4(1.0f);
    const auto a = find(before, after), b = find(before, after);
    ASSERT_EQ(a.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(a[i].region.lower, b[i].region.lower);
        EXPECT_EQ(a[i].region.upper, b[i].region.upper);
    }
}

// A slow door: no step is large, but together they are.
TEST_F(SceneEdits, aWatchAddsUpSlowMotions) {
    SceneWatch watch(scene, before.pose, before.lighting);
    int told = 0;
    for (int i = 1; i <= 40; ++i) {
        const State now(scene, 1 + 0.05f * float(i));
        const auto edits = watch.edits(now.pose, now.lighting, *now.trace(context));
        ASSERT_TRUE(edits);
        if (i == 1) {
            EXPECT_EQ(edits->size(), 2u) << "the fixture's lamp is off, its sun another one";
            continue;
        }
        for (const SceneEdit& edit : *edits) EXPECT_EQ(edit.kind, EditKind::object);
        told += int(edits->size());
    }
    // Its edge goes 1.1 m x 100 degrees = 1.9 m; a tenth of its size is 0.24 m.
    EXPECT_GE(told, 6);
    EXPECT_LE(told, 8);
    const State end(scene, 3);
    EXPECT_TRUE(watch.edits(end.pose, end.lighting, *end.trace(context))->empty());
}

TEST_F(SceneEdits, areAnnounced) {
    FieldDesc desc;
    desc.volumes[0].counts = {2, 2, 2};
    FieldControl control = makeFieldControl(desc, {});
    control.impl().advance();
    std::vector<SceneEdit> edits(2);
    edits[0].event = FieldEvent::largeLightChange;
    edits[0].region = {glm::vec3(0), glm::vec3(1)};
    edits[1].event = FieldEvent::smallLightChange;
    edits[1].everywhere = true;
    notify(control, edits);
    const UpdateFrame frame = control.impl().comingUpdate();
    EXPECT_EQ(frame.events.count, 1);
    EXPECT_FLOAT_EQ(frame.events.limitAt(glm::vec3(0.5f)).irradianceKept, 0.485f);
    EXPECT_FLOAT_EQ(frame.hysteresis.irradiance, 0.97f * 0.85f);
}

}  // namespace
}  // namespace probegi
