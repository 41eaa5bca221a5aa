// The library's own pipeline, from tracer to atlas, on every backend: trace, shade, blend, and the frame's books.
#include <cmath>
#include <numeric>

#include "backend/every_backend.h"
#include "backend/rich_scene.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;

/// A scene with a tracer of one backend and a small field in it.
struct Lit {
    Lit(const Context& context, const BackendMaker& backend, Scene own,
        const PlacementDesc& placement = {.counts = {6, 5, 5}}, FieldSetup desc = FieldDesc{.raysPerProbe = 64})
        : scene(std::move(own)), pose(poseAt(scene)), lighting{pose.lights, scene.sky} {
        const auto valid = validate(scene);
        EXPECT_TRUE(valid) << valid.error().message;
        desc.volumes = {offTheWalls(*placeVolume(pose.bounds, placement))};
        auto tried = backend.makeTracer(context, scene, pose);
        if (!tried) throw std::runtime_error(tried.error().message);
        tracer = std::move(*tried);
        auto made = backend.makeField(context, desc);
        if (!made) throw std::runtime_error(made.error().message);
        field.emplace(std::move(*made));
    }
    void run(int frames) {
        for (int i = 0; i < frames; ++i) ASSERT_TRUE(field->update(*tracer, lighting));
    }

    Scene scene;
    ScenePose pose;
    Lighting lighting;
    std::unique_ptr<Tracer> tracer;
    std::optional<Field> field;
};

std::vector<float> brightness(const Field& field) {
    std::vector<float> values;
    for (int probe = 0; probe < probeCount(field.desc()); ++probe)
        for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0),
                                  glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)})
            for (int c = 0; c < 3; ++c) values.push_back(probeIrradiance(field, probe, n)[c]);
    return values;
}

class BackendPipeline : public EveryBackend {
protected:
    Lit lit(Scene scene, const PlacementDesc& placement = {.counts = {6, 5, 5}},
            FieldSetup desc = FieldDesc{.raysPerProbe = 64}) const {
        return Lit(context, GetParam(), std::move(scene), placement, desc);
    }
    FieldQuery middle(const Lit& s) const { return {s.pose.bounds.centre(), {0, 1, 0}, {0, 1, 0}}; }
};
PROBEGI_ON_EVERY_BACKEND(BackendPipeline);

// All that shades a ray at once. Rays that pass an edge within rounding may see another surface: one ray of 64 changes
// a direction's mean by several per cent, so single values are bound loosely and their mean tightly.
TEST_P(BackendPipeline, probesHoldWhatTheCpusHold) {
    Lit own = lit(richScene()), reference(context, kCpu, richScene());
    for (const int frames : {1, 3}) {
        own.run(frames);
        reference.run(frames);
        const auto got = brightness(*own.field), want = brightness(*reference.field);
        const double mean = std::accumulate(want.begin(), want.end(), 0.0) / double(want.size());
        ASSERT_GT(mean, 0.1);
        double sum = 0, worst = 0;
        std::size_t differing = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            const double difference = std::abs(double(got[i]) - want[i]);
            sum += difference;
            worst = std::max(worst, difference);
            differing += difference > 0.006 * want[i] + 1e-6 ? 1 : 0;  // more than a storage step
        }
        EXPECT_LT(sum / double(got.size()), 1e-3 * mean) << "after " << own.field->control().frame() << " updates";
        EXPECT_LT(double(differing), 0.01 * double(got.size()));
        EXPECT_LT(worst, 0.25 * mean);
        RecordProperty("worst", std::to_string(worst / mean));
        for (int probe = 0; probe < probeCount(own.field->desc()); ++probe)
            EXPECT_NEAR(probeBackfaceShare(*own.field, probe), probeBackfaceShare(*reference.field, probe), 0.04f);
    }
}

// Any tracer serves any backend: here the CPU's.
TEST_P(BackendPipeline, tracesWithTheCpusTracerToo) {
    Lit reference(context, kCpu, richScene());
    Field field = makeField(reference.field->desc());
    for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(field.update(*reference.tracer, reference.lighting));
    reference.run(3);
    const auto got = brightness(field), want = brightness(*reference.field);
    for (std::size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i], want[i], 0.02f * want[i] + 1e-4f);
}

// Closed box of albedo a and emission Le: E = pi Le / (1 - a) at every point and normal, to 1 %.
TEST_P(BackendPipeline, furnaceHasItsClosedFormAtEveryLevel) {
    for (const float emission : {1e-3f, 1.0f, 1e3f}) {
        Lit s = lit(*makeBuiltinScene("furnace", {.albedo = 0.5f, .emission = emission}), {.counts = {4, 4, 4}},
                    FieldSetup(FieldDesc{.raysPerProbe = 32}, {.hysteresis = 0.7f}));
        s.run(50);
        const double expected = double(kPi) * emission / 0.5;
        std::vector<FieldQuery> queries = randomQueries(200);
        for (FieldQuery& q : queries) {
            q.position = s.pose.bounds.centre() + 0.12f * q.position * s.pose.bounds.size();
            q.toViewer = q.normal;
        }
        for (const glm::vec3& e : ask(*s.field, queries))
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c] / expected, 1.0, 0.01) << emission;
    }
}

// Storage must keep energy in both directions: after a change of brightness the plain hysteresis reaches the new level
// from below and from above, in steps far below the storage's own.
TEST_P(BackendPipeline, brighteningAndDarkeningBothArrive) {
    for (const auto& [from, to] : {std::pair{1.0f, 1.1f}, {1.1f, 1.0f}, {1e-3f, 1e3f}, {1e3f, 1e-3f}, {5.0f, 4.9f}}) {
        FieldSetup desc;
        desc.rules = FieldRules::paper;
        desc.volumes = {{{0, 0, 0}, glm::vec3(1), {2, 2, 2}}};
        desc.raysPerProbe = 32;
        desc.hysteresis = 0.97f;
        desc.significantChange = desc.newDistribution = 0;
        Field field = makeField(desc);
        ASSERT_TRUE(field.update(constantData(desc, glm::vec3(from), 1.0f)));
        // The distance left shrinks with hysteresis^n: 4.6 time constants for 1 %, more for a change of 1e6.
        const int frames = int((from / to > 100 || to / from > 100 ? 12 : 7) / (1 - desc.hysteresis));
        const auto data = constantData(desc, glm::vec3(to), 1.0f);
        for (int i = 0; i < frames; ++i) ASSERT_TRUE(field.update(data));
        for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, 0.8f)})
            EXPECT_NEAR(field.irradiance({glm::vec3(0.7f, 0.8f, 0.4f), n, n}).x / (kPi * to), 1.0, 0.01)
                << from << " to " << to;
    }
}

TEST_P(BackendPipeline, probesInWallsAreFound) {
    Lit s = lit(*makeBuiltinScene("cornell"), {.counts = {6, 6, 6}});
    s.run(1);
    int inside = 0, open = 0;
    for (int probe = 0; probe < probeCount(s.field->desc()); ++probe) {
        const float share = probeBackfaceShare(*s.field, probe);
        ASSERT_TRUE(share >= 0.0f && share <= 1.0f);
        (share > 0.3f ? inside : open) += 1;
    }
    EXPECT_GT(open, 0);
    EXPECT_GT(inside, 0);
    EXPECT_LT(probeBackfaceShare(*s.field, 2 + 6 * (3 + 6 * 2)), 0.05f);  // in the box, above the blocks
}

// How long a stage takes is for benchmarks to judge.
TEST_P(BackendPipeline, everyUpdateIsAFrameWithTimes) {
    Lit s = lit(richScene());
    for (int frame = 1; frame <= 3; ++frame) {
        const UpdateTimes t = *s.field->update(*s.tracer, s.lighting);
        for (const double time : {t.trace, t.shade, t.blend, t.total}) EXPECT_TRUE(std::isfinite(time) && time >= 0);
        EXPECT_EQ(s.field->control().frame(), frame);
    }
}

TEST_P(BackendPipeline, convergeStopsAtItsToleranceAndReportsEachUpdate) {
    Lit s = lit(*makeBuiltinScene("cornell"), {.counts = {6, 6, 6}}, FieldDesc{.raysPerProbe = 48});
    int reported = 0;
    const auto loose = s.field->converge(*s.tracer, s.lighting, 0.5f, 64, [&](const UpdateTimes&) { ++reported; });
    ASSERT_TRUE(loose);
    EXPECT_TRUE(loose->converged);
    EXPECT_LT(loose->updates, 64);
    EXPECT_EQ(reported, loose->updates);
    const auto capped = s.field->converge(*s.tracer, s.lighting, 1e-7f, 20);
    ASSERT_TRUE(capped);
    EXPECT_EQ(capped->updates, 20);
    EXPECT_FALSE(capped->converged);
    EXPECT_GT(capped->remaining, 1e-7f);
    EXPECT_FALSE(s.field->converge(*s.tracer, s.lighting, 0.0f));
    EXPECT_FALSE(s.field->converge(*s.tracer, s.lighting, NAN));
    EXPECT_FALSE(s.field->converge(*s.tracer, s.lighting, 0.1f, 0));
}

// The average in linear space, which plain updates do not take, is the CPU's as well.
TEST_P(BackendPipeline, convergedProbesHoldWhatTheCpusHold) {
    Lit own = lit(richScene(), {.counts = {4, 4, 4}}, FieldDesc{.raysPerProbe = 32});
    Lit reference(context, kCpu, richScene(), {.counts = {4, 4, 4}}, FieldDesc{.raysPerProbe = 32});
    ASSERT_EQ(own.field->converge(*own.tracer, own.lighting, 1e-6f, 12)->updates, 12);
    ASSERT_EQ(reference.field->converge(*reference.tracer, reference.lighting, 1e-6f, 12)->updates, 12);
    const auto got = brightness(*own.field), want = brightness(*reference.field);
    const double mean = std::accumulate(want.begin(), want.end(), 0.0) / double(want.size());
    double sum = 0;
    for (std::size_t i = 0; i < got.size(); ++i) sum += std::abs(double(got[i]) - want[i]);
    EXPECT_LT(sum / double(got.size()), 1e-3 * mean);
}

// Many bounces: an update that steps ahead of its light, on every backend.
TEST_P(BackendPipeline, convergeFollowsManyBounces) {
    Lit s = lit(*makeBuiltinScene("furnace", {.albedo = 0.9f}), {.counts = {4, 4, 4}}, FieldDesc{.raysPerProbe = 32});
    const auto done = s.field->converge(*s.tracer, s.lighting, 0.01f, 128);
    ASSERT_TRUE(done);
    EXPECT_TRUE(done->converged);
    EXPECT_LE(done->updates, 32);
    const double expected = double(kPi) * BuiltinParams{}.emission / 0.1;
    for (const glm::vec3& e : ask(*s.field, {{middle(s)}}))
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c] / expected, 1.0, 0.01);
}

TEST_P(BackendPipeline, convergeCanBeCancelled) {
    const Context stopping = *Context::create({.progress = [](const ProgressReport&) { return false; }});
    Lit s(stopping, GetParam(), *makeBuiltinScene("cornell"), {.counts = {3, 3, 3}}, FieldDesc{.raysPerProbe = 8});
    const auto result = s.field->converge(*s.tracer, s.lighting, 1e-9f, 100000);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

// A sudden change is followed faster when the field is told: irradiance and, for objects, distances.
TEST_P(BackendPipeline, eventsSpeedUpTheChange) {
    FieldSetup desc;
    desc.rules = FieldRules::paper;  // the others see the change by themselves
    desc.volumes = {{{0, 0, 0}, glm::vec3(1), {3, 3, 3}}};
    desc.raysPerProbe = 32;
    desc.significantChange = desc.newDistribution = 0;
    const auto afterChange = [&](std::optional<FieldEvent> event) {
        Field field = makeField(desc);
        EXPECT_TRUE(field.update(constantData(desc, glm::vec3(1.0f), 1.0f)));
        if (event) field.control().notify(*event);
        const auto dim = constantData(desc, glm::vec3(0.5f), 0.5f);
        for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(field.update(dim));
        return std::pair(field.irradiance({glm::vec3(1.2f), {0, 1, 0}, {0, 1, 0}}).x,
                         probeDistanceMoments(field, 13, {0, 0, 1}).x);
    };
    const auto untold = afterChange({}), small = afterChange(FieldEvent::smallLightChange),
               light = afterChange(FieldEvent::largeLightChange), object = afterChange(FieldEvent::largeObjectChange);
    EXPECT_NEAR(light.first, 0.5f * kPi, 0.1f);
    EXPECT_GT(small.first, light.first + 0.1f);
    EXPECT_GT(untold.first, small.first + 0.1f);
    EXPECT_NEAR(object.first, light.first, 0.01f);
    EXPECT_NEAR(light.second, untold.second, 1e-3f);
    EXPECT_LT(object.second, 0.52f);
    EXPECT_GT(untold.second, 0.9f);
}

TEST_P(BackendPipeline, memoryIsWithinItsBudget) {
    FieldSetup desc;
    desc.volumes[0].counts = {22, 14, 32};
    const Field field = makeField(desc);
    // Borders included, and four channels where a format has no three.
    EXPECT_LE(double(field.memory().persistentBytes()) / probeCount(desc), 2400.0);
    EXPECT_GE(double(field.memory().persistentBytes()) / probeCount(desc), 64 * 6 + 256 * 4);
}

TEST_P(BackendPipeline, fieldsComeAndGo) {
    const FieldSetup desc = smallDesc();
    const auto data = constantData(desc, glm::vec3(1.0f), 1.0f);
    for (int i = 0; i < 30; ++i) {
        Field field = makeField(desc);
        ASSERT_TRUE(field.update(data));
        Field moved = std::move(field);
        ASSERT_NEAR(moved.irradiance(randomQueries(1)[0]).y, kPi, 1e-3f);
    }
}

TEST_P(BackendPipeline, wrongAmountOfRayDataIsRefused) {
    Field field = makeField(smallDesc());
    const std::vector<RayDatum> tooFew(17);
    const auto result = field.update(tooFew);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(result.error().message.find("17"), std::string::npos);
    EXPECT_EQ(field.control().frame(), 0);
}

TEST_P(BackendPipeline, descsOutOfRangeAreRefused) {
    FieldSetup desc = smallDesc();
    desc.irradianceTexels = 7;
    const auto refused = GetParam().makeField(context, desc);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
}

TEST_P(BackendPipeline, raysTurnEveryFrameAndRepeatWithTheSeed) {
    const FieldSetup desc = smallDesc();
    Field a = makeField(desc), b = makeField(desc);
    const std::vector<glm::vec3> first(a.control().rayDirections().begin(), a.control().rayDirections().end());
    ASSERT_TRUE(a.update(constantData(desc, glm::vec3(1), 1)));
    EXPECT_NE(first[0], a.control().rayDirections()[0]);
    EXPECT_EQ(first[0], b.control().rayDirections()[0]);
    for (const glm::vec3& d : a.control().rayDirections()) EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
}

}  // namespace
}  // namespace probegi::test
