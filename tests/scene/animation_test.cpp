#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/animation.h"
#include "scene/mesh_checks.h"

namespace probegi {
namespace {

AnimationChannel ramp(Interpolation interpolation) {
    AnimationChannel c;
    c.node = 0;
    c.interpolation = interpolation;
    c.times = {1, 3, 4};
    c.values = {{0, 0, 0, 0}, {2, 4, 6, 0}, {3, 3, 3, 0}};
    return c;
}

glm::vec4 about(glm::vec3 axis, float angle) {
    const glm::quat q = glm::angleAxis(angle, axis);
    return {q.x, q.y, q.z, q.w};
}

TEST(Animation, StepHoldsTheLastKey) {
    const AnimationChannel c = ramp(Interpolation::step);
    EXPECT_EQ(sampleChannel(c, 2.999f), glm::vec4(0, 0, 0, 0));
    EXPECT_EQ(sampleChannel(c, 3.0f), glm::vec4(2, 4, 6, 0));
    EXPECT_EQ(sampleChannel(c, 3.999f), glm::vec4(2, 4, 6, 0));
    EXPECT_EQ(sampleChannel(c, 4.0f), glm::vec4(3, 3, 3, 0));
}

TEST(Animation, LinearMixesNeighbours) {
    const AnimationChannel c = ramp(Interpolation::linear);
    EXPECT_EQ(sampleChannel(c, 1.5f), glm::vec4(0.5f, 1, 1.5f, 0));
    EXPECT_EQ(sampleChannel(c, 3.5f), glm::vec4(2.5f, 3.5f, 4.5f, 0));
}

TEST(Animation, TimesAreClampedToTheKeys) {
    for (const Interpolation i : {Interpolation::step, Interpolation::linear}) {
        EXPECT_EQ(sampleChannel(ramp(i), -100), glm::vec4(0, 0, 0, 0));
        EXPECT_EQ(sampleChannel(ramp(i), 0.999f), glm::vec4(0, 0, 0, 0));
        EXPECT_EQ(sampleChannel(ramp(i), 1e30f), glm::vec4(3, 3, 3, 0));
    }
}

TEST(Animation, RotationsTurnAtConstantSpeed) {
    AnimationChannel c;
    c.path = AnimationPath::rotation;
    c.times = {0, 3};
    c.values = {about({0, 1, 0}, 0), about({0, 1, 0}, glm::half_pi<float>())};
    const glm::vec4 third = sampleChannel(c, 1), expected = about({0, 1, 0}, glm::half_pi<float>() / 3);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(third[k], expected[k], 1e-6f);
}

TEST(Animation, RotationsTakeTheShorterWay) {
    AnimationChannel c;
    c.path = AnimationPath::rotation;
    c.times = {0, 1};
    c.values = {about({0, 1, 0}, 0.2f), -about({0, 1, 0}, 0.6f)};  // the same rotation as the unnegated one
    const glm::vec4 middle = sampleChannel(c, 0.5f), expected = about({0, 1, 0}, 0.4f);
    EXPECT_NEAR(std::abs(glm::dot(middle, expected)), 1, 1e-6f);
}

/// value(t) = t^3 - 2 t, which a cubic Hermite spline reproduces exactly from values and slopes.
TEST(Animation, SplineReproducesACubic) {
    const auto value = [](float t) { return t * t * t - 2 * t; };
    const auto slope = [](float t) { return 3 * t * t - 2; };
    AnimationChannel c;
    c.interpolation = Interpolation::cubicSpline;
    for (const float t : {0.0f, 0.5f, 2.0f, 3.0f}) {
        c.times.push_back(t);
        c.values.insert(c.values.end(), {glm::vec4(slope(t)), glm::vec4(value(t)), glm::vec4(slope(t))});
    }
    for (float t = 0; t <= 3; t += 0.0625f) EXPECT_NEAR(sampleChannel(c, t).x, value(t), 2e-5f) << t;
}

TEST(Animation, SplineUsesTheOutTangentOfOneKeyAndTheInTangentOfTheNext) {
    AnimationChannel c;
    c.interpolation = Interpolation::cubicSpline;
    c.times = {0, 2};
    // The in-tangent of the first key and the out-tangent of the last must not matter.
    c.values = {glm::vec4(1e6f), glm::vec4(0), glm::vec4(3), glm::vec4(5), glm::vec4(1), glm::vec4(1e6f)};
    // Halfway: (v0 + v1) / 2 + span (b0 - a1) / 8 = 0.5 + 2 (3 - 5) / 8 = 0.
    EXPECT_NEAR(sampleChannel(c, 1).x, 0, 1e-6f);
    const float h = 1e-3f;
    EXPECT_NEAR(sampleChannel(c, h).x / h, 3, 0.02f);
    EXPECT_NEAR((1 - sampleChannel(c, 2 - h).x) / h, 5, 0.02f);
    EXPECT_EQ(sampleChannel(c, 0).x, 0);
    EXPECT_EQ(sampleChannel(c, 2).x, 1);
}

TEST(Animation, SplineRotationsAreUnit) {
    AnimationChannel c;
    c.path = AnimationPath::rotation;
    c.interpolation = Interpolation::cubicSpline;
    c.times = {0, 1};
    const glm::vec4 zero(0);
    c.values = {zero, about({1, 0, 0}, 0), zero, zero, about({1, 0, 0}, 2), zero};
    for (float t = 0; t <= 1; t += 0.1f) EXPECT_NEAR(glm::length(sampleChannel(c, t)), 1, 1e-6f);
}

TEST(Animation, ASplineThroughZeroIsNoRotation) {
    AnimationChannel c;
    c.path = AnimationPath::rotation;
    c.interpolation = Interpolation::cubicSpline;
    c.times = {0, 1};
    const glm::vec4 zero(0), one(0, 0, 0, 1);
    c.values = {zero, one, zero, zero, -one, zero};
    EXPECT_EQ(sampleChannel(c, 0.5f), one);
}

TEST(Animation, MovesItsNodeAndLeavesMatricesAlone) {
    Scene scene = test::sceneOf(test::triangle());
    scene.nodes[0].translation = {100, 0, 0};
    scene.animations.push_back(ramp(Interpolation::linear));
    ASSERT_TRUE(validate(scene));
    EXPECT_EQ(glm::vec3(poseAt(scene, 1.5f).instances[0].toWorld[3]), glm::vec3(0.5f, 1, 1.5f));
    scene.nodes[0].matrix = glm::mat4(1);
    EXPECT_EQ(poseAt(scene, 1.5f).instances[0].toWorld, glm::mat4(1));
}

TEST(Animation, ScalesAndRotatesThroughThePose) {
    Scene scene = test::sceneOf(test::triangle());
    AnimationChannel scale = ramp(Interpolation::linear);
    scale.path = AnimationPath::scale;
    AnimationChannel turn;
    turn.node = 0;
    turn.path = AnimationPath::rotation;
    turn.times = {0};
    turn.values = {2.0f * about({0, 0, 1}, glm::half_pi<float>())};  // not unit: normalised
    scene.animations = {scale, turn};
    const glm::mat4 m = poseAt(scene, 3).instances[0].toWorld;  // scale (2, 4, 6)
    const glm::vec4 x = m * glm::vec4(1, 0, 0, 0);
    EXPECT_NEAR(x.y, 2, 1e-5f);
    EXPECT_NEAR(x.x, 0, 1e-5f);
}

}  // namespace
}  // namespace probegi
