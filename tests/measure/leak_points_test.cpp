// What a look-up owes to hidden probes, against closed forms and against the field's own answers.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "measure/audit/field_record.h"
#include "probegi/builtin_scenes.h"
#include "probegi/measure.h"
#include "probegi/shapes.h"
#include "support/field_setup.h"

namespace probegi::test {
namespace {

constexpr double kPi = 3.14159265358979;

const Context& oneThread() {
    static const Context context = *Context::create({.threads = 1});
    return context;
}

/// A wall from x = -0.05 to 0.05, wider than anything that matters.
Scene wallScene() {
    Scene scene;
    scene.materials.emplace_back();
    Primitive wall;
    wall.material = 0;
    addBox(wall, {-0.05f, -20, -20}, {0.05f, 20, 20});
    addObject(scene, std::move(wall));
    return scene;
}

/// Four by two by two probes a metre apart, two layers on each side of the wall, which see `left` and `right`.
Field sides(float left, float right, LeakGuard guard = LeakGuard::none) {
    FieldSetup setup;
    setup.volumes = {{{-1.5f, -0.5f, -0.5f}, glm::vec3(1), {4, 2, 2}}};
    setup.raysPerProbe = 16;
    setup.rules = FieldRules::paper;
    setup.guard = guard;
    Field field = setup.make(oneThread()).value();
    std::vector<RayDatum> data;
    for (int i = 0; i < 4 * 2 * 2 * 16; ++i) data.push_back({glm::vec3(i / 16 % 4 < 2 ? left : right), 100.0f});
    EXPECT_TRUE(field.update(data));
    return field;
}

/// In the air, 0.2 m right of the wall's middle, in the middle of its cage on the other axes.
const FieldQuery kBeside{{0.2f, 0, 0}, {0, 1, 0}, {0, 1, 0}};

/// Share of the left probes by section 2.2 to the letter: trilinear times the smooth backface weight with its 0.2.
double shareOfLeft() {
    const auto side = [](double along, double trilinear) {
        const double length = std::sqrt(along * along + 0.5);
        double sum = 0;
        for (const double up : {0.5, -0.5}) sum += std::pow(0.5 + 0.5 * up / length, 2) + 0.2;
        return trilinear * sum;
    };
    const double left = side(0.7, 0.3), right = side(0.3, 0.7);
    return left / (left + right);
}

LeakPoint leakOf(const Field& field, const FieldQuery& query) {
    const Scene scene = wallScene();
    const auto tracer = makeEmbreeTracer(oneThread(), scene, poseAt(scene)).value();
    return leaksAt(oneThread(), *tracer, field, std::span(&query, 1)).value().front();
}

TEST(LeakPoints, weightsOfTwoSidesAreKnown) {
    const LeakPoint leak = leakOf(sides(1, 0), kBeside);
    EXPECT_NEAR(leak.hidden, shareOfLeft(), 2e-3);
    EXPECT_TRUE(leak.probesSee);
    EXPECT_EQ(leak.beyond, 0);
    EXPECT_LT(leak.probe.x, 0) << "on the other side";
    const double facing = 0.5 / std::sqrt(0.99), up = std::pow(0.5 + 0.5 * facing, 2) + 0.2,
                 down = std::pow(0.5 - 0.5 * facing, 2) + 0.2;
    EXPECT_NEAR(leak.slotShare, leak.hidden * 0.5 * up / (up + down), 2e-3) << "one of the two above";
}

// Light is averaged as the square root of the mean radiance.
TEST(LeakPoints, lightOfABrightSideLeaksIn) {
    const LeakPoint leak = leakOf(sides(1, 0), kBeside);
    const double s = shareOfLeft();
    EXPECT_NEAR(leak.light, kPi * s * s, 0.02 * kPi * s * s);
    EXPECT_NEAR(leak.unleaked, 0, 1e-6);
    EXPECT_NEAR(leak.leak, s * s, 0.02 * s * s);
}

TEST(LeakPoints, shadowOfADarkSideLeaksOut) {
    const LeakPoint leak = leakOf(sides(0, 1), kBeside);
    const double s = 1 - shareOfLeft();
    EXPECT_NEAR(leak.unleaked, kPi, 0.02 * kPi);
    EXPECT_NEAR(leak.leak, s * s - 1, 0.02);
}

TEST(LeakPoints, sidesThatAreLitAlikeDoNotLeak) {
    const LeakPoint leak = leakOf(sides(1, 1), kBeside);
    EXPECT_NEAR(leak.hidden, shareOfLeft(), 2e-3);
    EXPECT_NEAR(leak.leak, 0, 1e-3);
}

TEST(LeakPoints, nothingInBetweenHidesNothing) {
    // Two cells to the right all eight probes are on the point's side.
    const LeakPoint leak = leakOf(sides(1, 0), {{1.2f, 0, 0}, {0, 1, 0}, {0, 1, 0}});
    EXPECT_EQ(leak.hidden, 0);
    EXPECT_EQ(leak.leak, 0);
    EXPECT_EQ(leak.slot, -1);
}

TEST(LeakPoints, knowTheDistanceFromTheVolume) {
    EXPECT_NEAR(leakOf(sides(1, 0), {{4.5f, 0, 0}, {0, 1, 0}, {}}).beyond, 3, 1e-5);
}

TEST(LeakPoints, ofAnEmptyFieldAreBlack) {
    FieldSetup setup;
    const LeakPoint leak = leakOf(setup.make(oneThread()).value(), kBeside);
    EXPECT_EQ(leak.light, 0);
    EXPECT_EQ(leak.leak, 0);
}

TEST(LeakPoints, ofNoPointsAreNone) {
    const Scene scene = wallScene();
    const auto tracer = makeEmbreeTracer(oneThread(), scene, poseAt(scene)).value();
    EXPECT_TRUE(leaksAt(oneThread(), *tracer, sides(1, 0), {}).value().empty());
}

// The audit takes the look-up apart with its own kernels over a snapshot: the pieces must add up to the field's answer,
// by all rules and guards, in volumes that are turned, scrolled and several.
TEST(LeakPoints, lightIsWhatTheFieldAnswers) {
    const Scene scene = makeBuiltinScene("two-rooms").value();
    const ScenePose pose = poseAt(scene);
    const auto tracer = makeEmbreeTracer(oneThread(), scene, pose).value();
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper})
        for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
            FieldSetup setup;
            const VolumeDesc turned{
                {-5, -0.5f, -2}, glm::vec3(1.1f), {5, 4, 5}, glm::angleAxis(0.4f, glm::vec3(0, 1, 0))};
            setup.volumes = {{{0.3f, -0.5f, -3}, glm::vec3(1.3f), {5, 4, 5}}, turned};
            setup.raysPerProbe = 32;
            setup.rules = rules;
            setup.guard = guard;
            Field field = setup.make(oneThread()).value();
            for (int i = 0; i < 3; ++i) {
                if (i == 1) {
                    ASSERT_TRUE(field.scroll(0, {1, 0, -1}));
                }
                ASSERT_TRUE(field.update(*tracer, {pose.lights, scene.sky}));
            }
            const auto points = surfacePoints(scene, pose, *tracer, 300).value();
            const auto leaks = leaksAt(oneThread(), *tracer, field, points).value();
            const auto light = lightAt(field, points).value();
            for (std::size_t i = 0; i < points.size(); ++i)
                EXPECT_NEAR(leaks[i].light, light[i], 1e-4 * light[i] + 1e-6) << i;
        }
}

}  // namespace
}  // namespace probegi::test
