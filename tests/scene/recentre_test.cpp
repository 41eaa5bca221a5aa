#include "scene/recentre.h"

#include <gtest/gtest.h>

namespace probegi {
namespace {

/// A triangle of 3 x 2 m at `at`, with everything else that has a position in a scene.
Scene sceneAt(glm::vec3 at, bool byVertices = false) {
    const glm::vec3 nodeAt = byVertices ? glm::vec3(0.0f) : at;
    const glm::vec3 meshAt = byVertices ? at : glm::vec3(0.0f);
    Scene scene;
    scene.materials.push_back({});
    Primitive triangle;
    triangle.positions = {meshAt, meshAt + glm::vec3(3, 0, 0), meshAt + glm::vec3(0, 2, 0)};
    triangle.indices = {0, 1, 2};
    scene.meshes.push_back({"", {triangle}});
    scene.lights.push_back({});
    scene.cameras.push_back({});
    Node root;
    root.translation = nodeAt;
    scene.addNode(root);
    Node child;
    child.parent = 0;
    child.mesh = 0;
    child.translation = {0.125f, 0, 0};
    scene.addNode(child);
    Node lamp;
    lamp.matrix = glm::mat4(1.0f);
    (*lamp.matrix)[3] = glm::vec4(at + glm::vec3(1, 1, 1), 1);
    lamp.light = 0;
    scene.addNode(lamp);
    Node camera;
    camera.camera = 0;
    camera.translation = at + glm::vec3(0, 0, 4);
    scene.addNode(camera);
    scene.grid = VolumeDesc{at, glm::vec3(0.5f), glm::ivec3(4)};
    scene.furtherGrids = {VolumeDesc{at + 1.0f, glm::vec3(0.25f), glm::ivec3(3)}};
    return scene;
}

// All coordinates are multiples of 1/32 m, the resolution of floats at half a million metres.
const glm::vec3 kFar(500'000, -20, 300'000);

void expectSameScene(const Scene& moved, const Scene& reference) {
    const ScenePose a = poseAt(moved), b = poseAt(reference);
    const glm::vec3 shift = a.bounds.lower - b.bounds.lower;
    EXPECT_EQ(a.bounds.upper - b.bounds.upper, shift);
    EXPECT_EQ(a.lights[0].position - b.lights[0].position, shift);
    EXPECT_EQ(a.cameras[0].position - b.cameras[0].position, shift);
    EXPECT_EQ(moved.grid->origin - reference.grid->origin, shift);
    EXPECT_EQ(moved.furtherGrids[0].origin - reference.furtherGrids[0].origin, shift);
    EXPECT_EQ(moved.origin + shift, kFar);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(a.bounds.centre()[axis]), 4) << axis;
}

TEST(Recentre, MovesEverythingWithoutLosingADigit) {
    for (const bool byVertices : {false, true}) {
        Scene scene = sceneAt(kFar, byVertices);
        ASSERT_TRUE(recentre(scene));
        expectSameScene(scene, sceneAt(glm::vec3(0.0f)));
        EXPECT_TRUE(validate(scene));
        EXPECT_FALSE(recentre(scene)) << "once is enough";
    }
}

TEST(Recentre, LeavesWhatIsNearAlone) {
    for (const glm::vec3 at : {glm::vec3(0), glm::vec3(40, 0, 0), glm::vec3(-10, 30, 20)}) {
        Scene scene = sceneAt(at);
        EXPECT_FALSE(recentre(scene));
        EXPECT_EQ(scene.nodes[0].translation, at);
        EXPECT_EQ(scene.origin, glm::vec3(0.0f));
    }
    Scene empty;
    EXPECT_FALSE(recentre(empty));
}

TEST(Recentre, AnimatedRootsMoveToo) {
    for (const bool cubic : {false, true}) {
        Scene scene = sceneAt(kFar);
        AnimationChannel channel;
        channel.node = 0;
        channel.path = AnimationPath::translation;
        channel.interpolation = cubic ? Interpolation::cubicSpline : Interpolation::linear;
        channel.times = {0, 1};
        const glm::vec4 still(kFar, 0), moved(kFar + glm::vec3(4, 0, 0), 0), tangent(1, 0, 0, 0);
        if (cubic)
            channel.values = {tangent, still, tangent, tangent, moved, tangent};
        else
            channel.values = {still, moved};
        scene.animations.push_back(channel);
        const ScenePose before = poseAt(scene, 1.0f);
        ASSERT_TRUE(recentre(scene));
        const ScenePose after = poseAt(scene, 1.0f);
        EXPECT_EQ(after.bounds.lower + scene.origin, before.bounds.lower);
        if (cubic) {
            EXPECT_EQ(scene.animations[0].values[0], tangent);
        }
    }
}

}  // namespace
}  // namespace probegi
