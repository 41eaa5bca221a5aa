#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/mesh_checks.h"

namespace probegi {
namespace {

constexpr float kHalfPi = glm::half_pi<float>();

void expectNear(glm::vec3 actual, glm::vec3 expected, float tolerance = 1e-5f) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
    EXPECT_NEAR(actual.z, expected.z, tolerance);
}

glm::vec3 apply(const glm::mat4& m, glm::vec3 p) {
    return glm::vec3(m * glm::vec4(p, 1));
}

TEST(Pose, AppliesScaleThenRotationThenTranslation) {
    Scene scene = test::sceneOf(test::triangle());
    scene.nodes[0].translation = {10, 20, 30};
    scene.nodes[0].rotation = glm::angleAxis(kHalfPi, glm::vec3(0, 1, 0));
    scene.nodes[0].scale = {2, 3, 4};
    const ScenePose pose = poseAt(scene);
    ASSERT_EQ(pose.instances.size(), 1u);
    // (1, 1, 1) -> (2, 3, 4) -> a quarter turn about Y takes z to x and x to -z -> (4, 3, -2) -> moved.
    expectNear(apply(pose.instances[0].toWorld, {1, 1, 1}), {14, 23, 28});
}

TEST(Pose, ChildrenFollowTheirParents) {
    Scene scene = test::sceneOf(test::triangle());
    scene.nodes[0].mesh = -1;
    scene.nodes[0].translation = {5, 0, 0};
    scene.nodes[0].rotation = glm::angleAxis(kHalfPi, glm::vec3(0, 0, 1));
    Node child;
    child.parent = 0;
    child.matrix = glm::translate(glm::mat4(1), {1, 0, 0});
    child.translation = {99, 99, 99};  // the matrix replaces it
    scene.addNode(child);
    Node grandchild;
    grandchild.parent = 1;
    grandchild.mesh = 0;
    grandchild.scale = glm::vec3(2);
    scene.addNode(grandchild);
    const ScenePose pose = poseAt(scene);
    ASSERT_EQ(pose.instances.size(), 1u);
    EXPECT_EQ(pose.instances[0].node, 2);
    // (1, 0, 0) -> 2 -> 3 along the child's X, which is the world's Y, at x = 5.
    expectNear(apply(pose.instances[0].toWorld, {1, 0, 0}), {5, 3, 0});
}

TEST(Pose, BoundsEncloseTransformedTrianglesOnly) {
    Scene scene = test::sceneOf(test::triangle());
    scene.meshes[0].primitives[0].positions.push_back({1000, 1000, 1000});  // used by no triangle
    scene.nodes[0].translation = {1, 2, 3};
    Node second;
    second.mesh = 0;
    second.scale = {-4, 1, 1};
    scene.addNode(second);
    const ScenePose pose = poseAt(scene);
    expectNear(pose.bounds.lower, {-4, 0, 0});
    expectNear(pose.bounds.upper, {2, 3, 3});
    EXPECT_EQ(triangleCount(scene, pose), 2u);
    // Each triangle for itself.
    const std::vector<Bounds> each = triangleBounds(scene, pose);
    ASSERT_EQ(each.size(), 2u);
    expectNear(glm::min(each[0].lower, each[1].lower), {-4, 0, 0});
    expectNear(glm::max(each[0].upper, each[1].upper), {2, 3, 3});
    expectNear(each[0].lower, {1, 2, 3});
}

TEST(Pose, WithoutTrianglesTheBoundsAreEmpty) {
    const ScenePose pose = poseAt(Scene{});
    EXPECT_EQ(pose.bounds.size(), glm::vec3(0));
    EXPECT_EQ(triangleCount(Scene{}, pose), 0u);
    EXPECT_TRUE(triangleBounds(Scene{}, pose).empty());
}

TEST(Pose, WhatIsScaledToNothingIsLeftOut) {
    Scene scene = test::sceneOf(test::triangle());
    scene.nodes[0].scale = glm::vec3(0);
    EXPECT_TRUE(poseAt(scene).instances.empty());
    scene.nodes[0].scale = {1, 1, 0};  // flat, but still visible
    EXPECT_EQ(poseAt(scene).instances.size(), 1u);
}

TEST(Pose, LightsShineAlongMinusZ) {
    Scene scene;
    Light light;
    light.type = LightType::spot;
    light.intensity = {1, 2, 3};
    light.range = 7;
    light.innerConeAngle = 0.5f;
    light.outerConeAngle = 1.0f;
    scene.lights.push_back(light);
    Node node;
    node.light = 0;
    node.translation = {1, 2, 3};
    node.rotation = glm::angleAxis(-kHalfPi, glm::vec3(1, 0, 0));
    node.scale = glm::vec3(5);
    scene.addNode(node);
    const ScenePose pose = poseAt(scene);
    ASSERT_EQ(pose.lights.size(), 1u);
    const PlacedLight& placed = pose.lights[0];
    EXPECT_EQ(placed.type, LightType::spot);
    expectNear(placed.position, {1, 2, 3});
    expectNear(placed.direction, {0, -1, 0});
    expectNear(placed.intensity, {1, 2, 3});
    EXPECT_FLOAT_EQ(placed.range, 7);
    EXPECT_FLOAT_EQ(placed.cosInner, std::cos(0.5f));
    EXPECT_FLOAT_EQ(placed.cosOuter, std::cos(1.0f));
}

TEST(Pose, CamerasLookAlongMinusZWithYUp) {
    Scene scene;
    Camera camera;
    camera.name = "side";
    camera.yfov = 0.7f;
    scene.cameras.push_back(camera);
    Node node;
    node.camera = 0;
    node.translation = {0, 1, 0};
    // A quarter turn about Y, then a roll of a quarter turn about the viewing axis.
    node.rotation = glm::angleAxis(kHalfPi, glm::vec3(0, 1, 0)) * glm::angleAxis(kHalfPi, glm::vec3(0, 0, 1));
    scene.addNode(node);
    const ScenePose pose = poseAt(scene);
    ASSERT_EQ(pose.cameras.size(), 1u);
    EXPECT_EQ(pose.cameras[0].name, "side");
    EXPECT_FLOAT_EQ(pose.cameras[0].yfov, 0.7f);
    expectNear(pose.cameras[0].position, {0, 1, 0});
    expectNear(pose.cameras[0].forward, {-1, 0, 0});
    expectNear(pose.cameras[0].up, {0, 0, 1});
}

TEST(Camera, LookAtMakesAnOrthonormalFrame) {
    const glm::vec3 targets[] = {{1, 2, 3}, {0, 5, 0}, {0, -5, 0}, {-4, 0, 0}, {0, 0, 0}};
    for (const glm::vec3& at : targets) {
        const PlacedCamera camera = lookAt({0, 0, 0}, at, 0.5f);
        EXPECT_NEAR(glm::length(camera.forward), 1, 1e-6f);
        EXPECT_NEAR(glm::length(camera.up), 1, 1e-6f);
        EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0, 1e-6f);
        EXPECT_GE(camera.up.y, 0.0f);
        if (at != glm::vec3(0)) expectNear(camera.forward, glm::normalize(at));
    }
}

TEST(Camera, OverviewSeesAllCornersFromOutside) {
    const Bounds bounds{{-1, -20, 3}, {4, -8, 30}};
    const PlacedCamera camera = overviewCamera(bounds);
    const float limit = std::tan(0.5f * camera.yfov);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? bounds.upper.x : bounds.lower.x, corner & 2 ? bounds.upper.y : bounds.lower.y,
                          corner & 4 ? bounds.upper.z : bounds.lower.z);
        const glm::vec3 to = p - camera.position;
        const float depth = glm::dot(to, camera.forward);
        ASSERT_GT(depth, 0.0f);
        EXPECT_LT(glm::length(to - depth * camera.forward) / depth, limit);  // within the narrower field of view
    }
}

TEST(Camera, OverviewOfAPointStaysFinite) {
    const PlacedCamera camera = overviewCamera({});
    EXPECT_GT(glm::length(camera.position), 0.0f);
    EXPECT_TRUE(std::isfinite(camera.position.x));
}

}  // namespace
}  // namespace probegi
