// The temporal filter (kernels/blend/temporal_filter.h): light in motion is followed, light that stands still is still.
#include "backend/every_backend.h"

#include <algorithm>
#include <cmath>

#include "probegi/builtin_scenes.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;

class BackendMotion : public EveryBackend {};
PROBEGI_ON_EVERY_BACKEND(BackendMotion);

FieldSetup motionDesc() {
    FieldSetup desc;
    desc.volumes = {{{0, 0, 0}, glm::vec3(1), {3, 3, 3}}};
    return desc;
}

float inTheMiddle(const Field& field) {
    return field.irradiance({glm::vec3(1.2f), {0, 1, 0}, {0, 1, 0}}).x;
}

// Light without noise has nothing to wait for, whether or not there are fixed rays.
TEST_P(BackendMotion, evenLightIsFollowedInTwoUpdates) {
    for (const bool withFixedRays : {true, false})
        for (const float factor : {0.1f, 0.8f, 1.25f, 10.0f}) {
            const FieldSetup desc = motionDesc();
            Field field = makeField(desc);
            const auto update = [&](float light) {
                const std::size_t fixed = withFixedRays ? std::size_t(probeCount(desc) * desc.fixedRays) : 0;
                const std::vector<FixedRayDatum> fixedData(fixed, {light, 0.0f, 1.0f});
                ASSERT_TRUE(field.update(constantData(desc, glm::vec3(light), 1.0f), fixedData));
            };
            for (int frame = 0; frame < 100; ++frame) update(1.0f);
            EXPECT_NEAR(inTheMiddle(field) / kPi, 1.0f, 0.002f);
            for (int frame = 0; frame < 2; ++frame) update(factor);
            EXPECT_LT(std::abs(inTheMiddle(field) / kPi - factor), 0.1f * std::abs(1 - factor)) << factor;
        }
}

// Noise of the rays, with fixed rays that say that nothing happens: the mean is the mean, and the noise is averaged
// over a hundred updates and more.
TEST_P(BackendMotion, noiseUnderSteadyLightIsAveraged) {
    FieldSetup desc = motionDesc();
    desc.raysPerProbe = 16;
    Field field = makeField(desc);
    const std::vector<FixedRayDatum> fixedData(std::size_t(27 * desc.fixedRays), {1.0f, 0.2f, 1.0f});
    std::vector<std::vector<double>> light;
    const int watched = 40, before = 160;
    for (int frame = 0; frame < before + watched; ++frame) {
        auto data = constantData(desc, glm::vec3(0.0f), 1.0f);
        // One ray in sixteen is bright, another one in each frame and probe: mean 1.
        std::uint32_t state = std::uint32_t(frame) * 7919u + 1u;
        for (std::size_t probe = 0; probe < 27; ++probe) {
            state = state * 747796405u + 2891336453u;
            data[probe * 16 + (state >> 28)].radiance = glm::vec3(16.0f);
        }
        ASSERT_TRUE(field.update(data, fixedData));
        if (frame < before) continue;
        light.push_back({probeIrradiance(field, 13, {0, 1, 0}).x / kPi});
    }
    double mean = 0;
    for (const auto& e : light) mean += e[0] / watched;
    EXPECT_NEAR(mean, 1.0, 0.05);                        // encoded averaging of the same data gives 0.3
    EXPECT_LT(made(measureFlicker(light)).mean, 0.035);  // 0.026; a window of 33 updates has 0.06
}

TEST_P(BackendMotion, fixedRaysOfTheWrongNumberAreRefused) {
    const FieldSetup desc = motionDesc();
    Field field = makeField(desc);
    const auto result = field.update(constantData(desc, glm::vec3(1), 1), std::vector<FixedRayDatum>(17));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(result.error().message.find("fixedRays has 17"), std::string::npos);
    EXPECT_EQ(field.control().frame(), 0);
}

TEST_P(BackendMotion, fixedRaysAreFixedAndThePaperHasNone) {
    FieldSetup desc = motionDesc();
    Field field = makeField(desc);
    ASSERT_EQ(field.control().fixedRayDirections().size(), 16u);
    const glm::vec3 first = field.control().fixedRayDirections()[3];
    ASSERT_TRUE(field.update(constantData(desc, glm::vec3(1), 1)));
    EXPECT_EQ(field.control().fixedRayDirections()[3], first);
    desc.rules = FieldRules::paper;
    EXPECT_TRUE(makeField(desc).control().fixedRayDirections().empty());
}

// What is no light must not reach the averages: it would never leave them.
TEST_P(BackendMotion, badFixedRaysDoNotPoisonTheFilter) {
    const FieldSetup desc = motionDesc();
    Field field = makeField(desc);
    const float nan = std::nanf("");
    std::vector<FixedRayDatum> fixedData(std::size_t(27 * desc.fixedRays), {1.0f, 0.0f, 1.0f});
    const auto data = constantData(desc, glm::vec3(1), 1);
    ASSERT_TRUE(field.update(data, fixedData));
    for (std::size_t i = 0; i < fixedData.size(); i += 5) fixedData[i] = {i % 2 ? nan : INFINITY, -nan, nan};
    ASSERT_TRUE(field.update(data, fixedData));
    for (FixedRayDatum& d : fixedData) d = {2.0f, 0.0f, 1.0f};
    for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(field.update(constantData(desc, glm::vec3(2), 1), fixedData));
    EXPECT_NEAR(inTheMiddle(field) / kPi, 2.0f, 0.01f);
}

// A door that shuts: distances are followed as well.
TEST_P(BackendMotion, distancesAreFollowed) {
    const FieldSetup desc = motionDesc();
    Field field = makeField(desc);
    const auto update = [&](float distance) {
        const std::vector<FixedRayDatum> fixedData(std::size_t(27 * desc.fixedRays), {1.0f, 0.0f, distance});
        ASSERT_TRUE(field.update(constantData(desc, glm::vec3(1), distance), fixedData));
    };
    for (int frame = 0; frame < 60; ++frame) update(2.0f);
    for (int frame = 0; frame < 2; ++frame) update(0.5f);
    EXPECT_NEAR(probeDistanceMoments(field, 13, {0, 0, 1}).x, 0.5f, 0.02f);
}

std::vector<int> openProbes(const Field& field) {
    std::vector<int> probes;
    for (int probe = 0; probe < probeCount(field.desc()); ++probe)
        if (probeBackfaceShare(field, probe) < 0.1f) probes.push_back(probe);
    return probes;
}

// What probes see, by the six axes.
std::vector<double> lightOf(const Field& field, std::span<const int> probes) {
    std::vector<double> light;
    for (const int probe : probes)
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {-1.0f, 1.0f}) {
                glm::vec3 normal(0.0f);
                normal[axis] = sign;
                const glm::vec3 e = probeIrradiance(field, probe, normal);
                light.push_back((double(e.x) + e.y + e.z) / 3);
            }
    return light;
}

// As an engine that loads baked light, or converges once, and then updates it frame by frame. Measured: 0.011; an
// average of its own begins with 0.027.
TEST_P(BackendMotion, updatesGoOnFromWhatConverged) {
    const auto scene = makeBuiltinScene("atrium");
    ASSERT_TRUE(scene);
    const ScenePose pose = poseAt(*scene);
    FieldSetup desc;
    desc.volumes = {*placeVolume(pose.bounds, {.targetProbes = 100})};
    const Lighting lighting{pose.lights, scene->sky};
    const auto tracer = makeTracer(*scene, pose);
    Field field = makeField(desc);
    ASSERT_TRUE(field.converge(*tracer, lighting));
    const std::vector<int> probes = openProbes(field);
    ASSERT_GT(probes.size(), 30u);
    const std::vector<double> converged = lightOf(field, probes);
    const auto difference = [&] {
        const std::vector<double> now = lightOf(field, probes);
        double square = 0, mean = 0;
        for (std::size_t i = 0; i < now.size(); ++i) {
            square += (now[i] - converged[i]) * (now[i] - converged[i]);
            mean += converged[i];
        }
        return std::sqrt(square * double(now.size())) / mean;
    };
    for (int frame = 0; frame < 8; ++frame) {
        ASSERT_TRUE(field.update(*tracer, lighting));
        EXPECT_LT(difference(), 0.016) << "update " << frame;
    }
}

// The sun moves by an hour or two, and other patches of the walls send its light on. Measured: 0.06 left after three
// updates, 0.015 after six, less than 0.01 from the eighth on.
TEST_P(BackendMotion, aJumpOfTheSunIsFollowedInSixUpdates) {
    const auto scene = makeBuiltinScene("atrium");
    ASSERT_TRUE(scene);
    const ScenePose pose = poseAt(*scene);
    FieldSetup desc;
    desc.volumes = {*placeVolume(pose.bounds, {.targetProbes = 200})};
    const Lighting before{pose.lights, scene->sky};
    Lighting after = before;
    for (PlacedLight& light : after.lights)
        light.direction = glm::normalize(light.direction + glm::vec3(0.35f, 0.0f, -0.35f));
    const auto settled = [&](const Lighting& lighting) {
        Field field = made(Field::create(context, desc, desc));
        EXPECT_TRUE(field.converge(*made(makeEmbreeTracer(context, *scene, pose)), lighting, 1e-9f, 100));
        return field;
    };
    const Field first = settled(before);
    const std::vector<int> probes = openProbes(first);
    ASSERT_GT(probes.size(), 50u);
    const std::vector<double> start = lightOf(first, probes), goal = lightOf(settled(after), probes);
    const auto tracer = makeTracer(*scene, pose);
    Field field = makeField(desc);
    for (int frame = 0; frame < 40; ++frame) ASSERT_TRUE(field.update(*tracer, before));
    const auto left = [&] { return made(shareLeft(lightOf(field, probes), start, goal)); };
    EXPECT_NEAR(left(), 1.0, 0.1);
    for (int frame = 0; frame < 6; ++frame) ASSERT_TRUE(field.update(*tracer, after));
    EXPECT_LT(std::abs(left()), 0.05);
    for (int frame = 0; frame < 6; ++frame) {
        ASSERT_TRUE(field.update(*tracer, after));
        EXPECT_LT(std::abs(left()), 0.05);
    }
}

}  // namespace
}  // namespace probegi::test
