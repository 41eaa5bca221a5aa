// A scene with moving parts: after moves, its tracer agrees with a new one.
#include <algorithm>

#include "probegi/probegi.h"
#include "tracer/tracer_scene.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

constexpr int kDoor = 2;

/// A room, a movable lamp, a door, and an object attached to it.
Scene roomWithDoor() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].emission = glm::vec3(3);
    Primitive walls, lamp, door, knob;
    addRoom(walls, glm::vec3(-4, 0, -4), glm::vec3(4, 3, 4));
    lamp.material = 1;
    addBox(lamp, glm::vec3(-0.2f), glm::vec3(0.2f));
    addBox(door, {-1, 0, -0.05f}, {1, 2, 0.05f});
    addBox(knob, {0.8f, 1, 0.05f}, {0.9f, 1.1f, 0.2f});
    addObject(scene, walls, "walls");
    addObject(scene, lamp, "lamp");
    addObject(scene, door, "door");
    scene.nodes[std::size_t(addObject(scene, knob, "knob"))].parent = kDoor;
    scene.nodes[1].translation = {-2, 2, 1};
    return scene;
}

Scene opened(Scene scene, float angle) {
    scene.nodes[kDoor].rotation = glm::angleAxis(angle, glm::vec3(0, 1, 0));
    scene.nodes[kDoor].translation = {std::sin(angle), 0, 0.3f * angle};
    scene.nodes[1].translation.x += angle;
    return scene;
}

std::vector<Ray> randomRays(std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-1, 1);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const glm::vec3 direction(at(random), at(random), at(random));
        if (glm::length(direction) < 0.1f) continue;
        rays.push_back({{3 * at(random), 1.5f + at(random), 3 * at(random)}, 0, glm::normalize(direction), 1e30f});
    }
    return rays;
}

struct Answers {
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
    std::vector<std::uint8_t> blocked;
};

Answers ask(const Tracer& tracer, const std::vector<Ray>& rays) {
    Answers a{std::vector<Hit>(rays.size()), std::vector<Surface>(rays.size()), std::vector<std::uint8_t>(rays.size())};
    EXPECT_TRUE(tracer.closestHits(rays, a.hits));
    EXPECT_TRUE(tracer.surfaces(rays, a.hits, a.surfaces));
    EXPECT_TRUE(tracer.occluded(rays, a.blocked));
    return a;
}

/// Number of rays whose results differ by more than rounding.
int differing(const Answers& a, const Answers& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.hits.size(); ++i)
        count += a.blocked[i] != b.blocked[i] || std::abs(a.hits[i].distance - b.hits[i].distance) > 1e-4f ||
                 glm::distance(a.surfaces[i].geometricNormal, b.surfaces[i].geometricNormal) > 1e-3f;
    return count;
}

std::vector<TracerMaker> movableMakers() {
    std::vector<TracerMaker> makers;
    for (const TracerMaker& maker : tracerMakers())
        if (maker.makeMovable) makers.push_back(maker);
    return makers;
}

class MovingScene : public EveryTracer {
protected:
    std::unique_ptr<MovableTracer> makeMoving() const {
        return GetParam().makeMovable(context, scene, poseAt(scene), {.nodes = nodes}).value();
    }

    Context context = makeContext(2);
    Scene scene = roomWithDoor();
    std::vector<int> nodes{1, kDoor};
};
INSTANTIATE_TEST_SUITE_P(All, MovingScene, testing::ValuesIn(movableMakers()), nameOf<TracerMaker>);

TEST_P(MovingScene, AgreesWithANewTracer) {
    ASSERT_TRUE(validate(scene));
    const auto moving = makeMoving();
    const std::vector<Ray> rays = randomRays(4000);
    const Answers before = ask(*moving, rays);
    for (const float angle : {0.4f, 1.5f, 0.0f}) {
        SCOPED_TRACE(angle);
        const Scene now = opened(scene, angle);
        const ScenePose pose = poseAt(now);
        ASSERT_TRUE(moving->setPose(pose));
        const auto fresh = make(now, pose);
        EXPECT_LE(differing(ask(*moving, rays), ask(*fresh, rays)), 2) << "edges, where rounding decides";
        if (angle > 0) {
            EXPECT_GT(differing(ask(*moving, rays), before), 50) << "nothing moved";
        }
        EXPECT_LT(glm::distance(moving->bounds().lower, fresh->bounds().lower), 1e-5f);
        EXPECT_LT(glm::distance(moving->bounds().upper, fresh->bounds().upper), 1e-5f);
        ASSERT_EQ(moving->emitters()->triangles.size(), fresh->emitters()->triangles.size());
        for (std::size_t i = 0; i < fresh->emitters()->triangles.size(); ++i)
            EXPECT_LT(glm::distance(moving->emitters()->triangles[i].corner, fresh->emitters()->triangles[i].corner),
                      1e-5f);
    }
}

TEST_P(MovingScene, WhatIsNotMovableStays) {
    const auto moving = makeMoving();
    Scene shifted = scene;
    shifted.nodes[0].translation.x = 10;
    ASSERT_TRUE(moving->setPose(poseAt(shifted)));
    const std::vector<Ray> rays = randomRays(500);
    EXPECT_EQ(differing(ask(*moving, rays), ask(*make(scene, poseAt(scene)), rays)), 0);
}

TEST_P(MovingScene, RefusesPosesThatDoNotFit) {
    const auto moving = makeMoving();
    const std::vector<Ray> rays = randomRays(500);
    const Answers before = ask(*moving, rays);
    const Scene other{};
    Scene flat = scene;
    flat.nodes[kDoor].scale = {1, 1, 0};
    for (const Scene* bad : {&other, static_cast<const Scene*>(&flat)}) {
        const auto refused = moving->setPose(poseAt(*bad));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
        EXPECT_THAT(refused.error().message, HasSubstr("node "));
        EXPECT_EQ(differing(ask(*moving, rays), before), 0) << "as it was";
    }
    for (const int node : {-1, 4}) {
        const std::vector<int> wrong{node};
        const auto refused = GetParam().makeMovable(context, scene, poseAt(scene), {.nodes = wrong});
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message, HasSubstr("the scene has 4 nodes"));
    }
}

}  // namespace
}  // namespace probegi::test
