// Volumes that scroll (DDGI paper, section 7.3), on every backend.
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "backend/every_backend.h"
#include "backend/rich_scene.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;

VolumeDesc turned(VolumeDesc volume) {
    volume.orientation = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 0.5f)));
    return volume;
}

// A light and a distance that tell where a probe stands.
float lightAt(glm::vec3 place) {
    return 2 + std::sin(1.3f * place.x) + 0.5f * std::sin(0.9f * place.y) + 0.3f * std::sin(1.7f * place.z);
}
float distanceAt(glm::vec3 place) {
    return 0.4f + 0.1f * std::sin(place.x + 2 * place.y - place.z);
}

class BackendScroll : public EveryBackend {
protected:
    static FieldSetup setupOf(const VolumeDesc& volume, FieldRules rules) {
        FieldSetup setup;
        setup.volumes = {volume};
        setup.rules = rules;
        setup.raysPerProbe = 24;
        setup.fixedRays = 0;
        return setup;
    }
    static void updateByPlace(Field& field) {
        std::vector<RayDatum> data;
        for (const ProbeTask& task : field.control().tasks())
            data.insert(data.end(), std::size_t(field.desc().raysPerProbe),
                        {glm::vec3(lightAt(task.origin)), distanceAt(task.origin)});
        ASSERT_TRUE(field.update(data));
    }
    /// Whether a probe holds what belongs to its place.
    static void expectInPlace(const Field& field, const ProbeTask& task) {
        const glm::vec3 n(0.6f, 0, -0.8f);
        const FieldSnapshot probe = readProbe(field, int(task.slot));
        const float e = probe.probeIrradiance(int(task.slot), n).x / kPi;
        EXPECT_NEAR(e, lightAt(task.origin), 0.01f * lightAt(task.origin)) << task.slot;
        EXPECT_NEAR(probe.probeDistanceMoments(int(task.slot), n).x, distanceAt(task.origin), 2e-3f) << task.slot;
        EXPECT_EQ(probe.states[0].backfaceShare, 0.0f);
    }
    static bool isNewProbe(const Field& field, const ProbeTask& task) {
        const FieldSnapshot probe = readProbe(field, int(task.slot));
        ProbeState fresh;
        fresh.backfaceShare = 2.0f;
        return probe.states[0] == fresh && std::ranges::count(probe.irradiance, 0) == 3 * 64 &&
               std::ranges::count(probe.visibility, 0u) == 256;
    }

    const VolumeDesc small{.origin = {1, 2, 3}, .spacing = {0.5f, 0.7f, 0.6f}, .counts = {5, 3, 4}};
};
PROBEGI_ON_EVERY_BACKEND(BackendScroll);

// Walks with steps of all sizes, teleports among them. Probes that stay keep what they hold, to the bit; those that
// enter know nothing, and after one update hold what belongs to their place.
TEST_P(BackendScroll, afterAnyWalkProbesHoldWhatBelongsToTheirPlace) {
    for (const auto& [volume, rules] :
         {std::pair(small, FieldRules::measured), std::pair(turned(small), FieldRules::paper)}) {
        Field field = makeField(setupOf(volume, rules));
        updateByPlace(field);
        std::mt19937 random(5);
        std::uniform_int_distribution<int> step(-2, 2), far(-40, 40);
        for (int i = 0; i < 8; ++i) {
            auto& way = i == 4 ? far : step;
            const glm::ivec3 cells(way(random), way(random), way(random));
            const VolumeDesc before = field.control().place(0);
            const FieldSnapshot old = field.read().value();
            ASSERT_TRUE(field.scroll(0, cells));
            const VolumeDesc now = field.control().place(0);
            EXPECT_LT(
                glm::distance(now.origin, before.origin + before.orientation * (glm::vec3(cells) * before.spacing)),
                1e-3f);
            int entered = 0;
            for (const ProbeTask& task : field.control().tasks()) {
                const glm::vec3 cell =
                    glm::round(glm::conjugate(before.orientation) * (task.origin - before.origin) / before.spacing);
                const bool stays = glm::all(glm::greaterThanEqual(cell, glm::vec3(0))) &&
                                   glm::all(glm::lessThan(cell, glm::vec3(before.counts)));
                entered += stays ? 0 : 1;
                if (stays)
                    EXPECT_EQ(readProbe(field, int(task.slot)).states[0], old.state(int(task.slot)));
                else
                    EXPECT_TRUE(isNewProbe(field, task)) << i << ' ' << task.slot;
            }
            const glm::ivec3 staying = glm::max(before.counts - glm::abs(cells), glm::ivec3(0));
            EXPECT_EQ(entered, 60 - staying.x * staying.y * staying.z);
            updateByPlace(field);
            for (const ProbeTask& task : field.control().tasks()) expectInPlace(field, task);
        }
    }
}

// No trace of the way there: after a teleport a field is what one made in place is, bit for bit, whatever its phases.
TEST_P(BackendScroll, afterATeleportAFieldIsOneMadeInPlace) {
    const Scene scene = richScene();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = makeTracer(scene, pose);
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        VolumeDesc there = placeVolume(pose.bounds, {.counts = {4, 3, 4}}).value();
        there.spacing = glm::vec3(0.5f, 0.75f, 0.625f);  // exact, so that both have the same origin to the bit
        there.origin = glm::round(there.origin * 8.0f) / 8.0f;
        const glm::ivec3 cells(41, -22, 7);
        VolumeDesc start = there;
        start.origin -= glm::vec3(cells) * there.spacing;
        FieldSetup fixed = setupOf(there, rules), moved = setupOf(start, rules);
        fixed.fixedRays = moved.fixedRays = 16;
        Field inPlace = makeField(fixed), scrolled = makeField(moved);
        ASSERT_TRUE(scrolled.scroll(0, cells));
        ASSERT_EQ(scrolled.control().place(0), there);
        for (int i = 0; i < 4; ++i) {
            ASSERT_TRUE(inPlace.update(*tracer, lighting));
            ASSERT_TRUE(scrolled.update(*tracer, lighting));
        }
        const auto places = inPlace.control().tasks(), others = scrolled.control().tasks();
        for (const ProbeTask& task : others) {
            const auto same = std::ranges::find(places, task.origin, &ProbeTask::origin);
            ASSERT_NE(same, places.end());
            const FieldSnapshot a = readProbe(scrolled, int(task.slot)), b = readProbe(inPlace, int(same->slot));
            EXPECT_EQ(a.states[0], b.states[0]) << task.slot;
            EXPECT_TRUE(a.irradiance == b.irradiance && a.visibility == b.visibility) << task.slot;
        }
        for (int i = 0; i < 30; ++i) {
            const glm::vec3 share = glm::fract(glm::vec3(0.7548f, 0.5698f, 0.3247f) * float(i));
            const FieldQuery query{
                there.origin + share * there.spacing * glm::vec3(there.counts), {0, 1, 0}, {0, 1, 0}};
            EXPECT_EQ(scrolled.irradiance(query), inPlace.irradiance(query)) << i;
        }
    }
}

// A camera that walks: no look-up darkens where the window's edge has just moved.
TEST_P(BackendScroll, newProbesAreNotUsedBeforeTheirUpdate) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper})
        for (const LeakGuard guard : {LeakGuard::moments, LeakGuard::none}) {
            FieldSetup setup = setupOf(small, rules);
            setup.guard = guard;
            Field field = makeField(setup);
            std::vector<RayDatum> data(field.control().tasks().size() * 24, {glm::vec3(1.0f), 50.0f});
            ASSERT_TRUE(field.update(data));
            for (int i = 0; i < 5; ++i) {
                ASSERT_TRUE(field.scroll(0, {1, 0, i % 2 == 0 ? 1 : -1}));
                const VolumeDesc place = field.control().place(0);
                // Across the seam: some probes of the cage are old, some are new.
                const glm::vec3 at =
                    place.origin + (glm::vec3(place.counts - 1) - glm::vec3(0.6f, 1, 1.5f)) * place.spacing;
                EXPECT_NEAR(field.irradiance({at, {0, 1, 0}, {0, 1, 0}}).x, kPi, 0.02f * kPi) << i;
                ASSERT_TRUE(field.update(data));
                EXPECT_NEAR(field.irradiance({at, {0, 1, 0}, {0, 1, 0}}).x, kPi, 0.02f * kPi) << i;
            }
            ASSERT_TRUE(field.scroll(0, {100, 0, 0}));
            const glm::vec3 middle = field.control().place(0).origin + glm::vec3(1, 0.7f, 0.9f);
            EXPECT_EQ(field.irradiance({middle, {0, 1, 0}, {0, 1, 0}}), glm::vec3(0.0f)) << "nothing is known there";
        }
}

// Traced updates before and after, so that all which is kept between updates must go along: tasks, constants, phases.
TEST_P(BackendScroll, tracedUpdatesGoOnWhereTheWindowIs) {
    const Scene scene = richScene();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const auto tracer = makeTracer(scene, pose), cpuTracer = made(kCpu.makeTracer(context, scene, pose));
    FieldSetup setup =
        setupOf(offTheWalls(placeVolume(pose.bounds, {.counts = {6, 5, 5}}).value()), FieldRules::measured);
    setup.raysPerProbe = 64;
    setup.fixedRays = 16;
    Field field = makeField(setup), reference = made(kCpu.makeField(context, setup));
    const auto both = [&](const auto& act) { return act(field, *tracer) && act(reference, *cpuTracer); };
    const auto update = [&](Field& each, const Tracer& with) { return bool(each.update(with, lighting)); };
    for (const glm::ivec3 cells : {glm::ivec3(0), glm::ivec3(1, 0, -1), glm::ivec3(-2, 1, 0)}) {
        ASSERT_TRUE(both([&](Field& each, const Tracer&) { return bool(each.scroll(0, cells)); }));
        ASSERT_TRUE(both(update));
        ASSERT_TRUE(both(update));
        double sum = 0, difference = 0;
        for (int slot = 0; slot < probeCount(setup); ++slot) {
            const glm::vec3 e = probeIrradiance(field, slot, {0, 1, 0}),
                            same = probeIrradiance(reference, slot, {0, 1, 0});
            sum += same.y;
            difference += std::abs(e.y - same.y);
            EXPECT_NEAR(probeBackfaceShare(field, slot), probeBackfaceShare(reference, slot), 0.04f) << slot;
        }
        EXPECT_LT(difference, 2e-3 * sum);
    }
    // Converges to the same too, with its regions where the window is.
    ASSERT_TRUE(both([&](Field& each, const Tracer& with) { return bool(each.converge(with, lighting, 0.3f, 8)); }));
    const FieldQuery query{pose.bounds.centre(), {0, 1, 0}, {0, 1, 0}};
    const glm::vec3 e = field.irradiance(query), same = reference.irradiance(query);
    EXPECT_LT(glm::distance(e, same), 0.01f * glm::length(same));
}

TEST_P(BackendScroll, aSnapshotRemembersThePlace) {
    Field one = makeField(setupOf(small, FieldRules::measured)),
          other = makeField(setupOf(small, FieldRules::measured));
    ASSERT_TRUE(one.scroll(0, {3, -4, 9}));
    updateByPlace(one);
    const FieldSnapshot snapshot = one.read().value();
    EXPECT_EQ(snapshot.scrolled, std::vector<glm::ivec3>{glm::ivec3(3, -4, 9)});
    EXPECT_EQ(other.write(one.read({0, 2}).value()).error().code, ErrorCode::invalidArgument)
        << "slots of other places";
    ASSERT_TRUE(other.write(snapshot));
    EXPECT_EQ(other.control().place(0), one.control().place(0));
    for (const ProbeTask& task : other.control().tasks()) expectInPlace(other, task);
    const FieldQuery query{one.control().place(0).origin + 1.0f, {0, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(one.irradiance(query), other.irradiance(query));
}

// Each volume for itself, and chosen tasks go along.
TEST_P(BackendScroll, otherVolumesStay) {
    FieldSetup setup = setupOf(small, FieldRules::measured);
    VolumeDesc second = turned(small);
    second.origin = {20, 0, 0};
    setup.volumes.push_back(second);
    Field field = makeField(setup);
    updateByPlace(field);
    const std::vector<std::uint32_t> chosen{70, 61, 5};
    ASSERT_TRUE(field.control().setTasks(chosen));
    const FieldSnapshot before = field.read({0, 60}).value();
    ASSERT_TRUE(field.scroll(1, {1, 1, 0}));
    EXPECT_EQ(field.read({0, 60}).value().irradiance, before.irradiance);
    EXPECT_EQ(field.control().place(0), small);
    for (const ProbeTask& task : field.control().tasks()) {
        const VolumeDesc place = field.control().place(int(task.volume));
        const glm::vec3 cell = glm::conjugate(place.orientation) * (task.origin - place.origin) / place.spacing;
        EXPECT_LT(glm::distance(cell, glm::round(cell)), 1e-3f);
    }
    updateByPlace(field);
    for (const ProbeTask& task : field.control().tasks()) expectInPlace(field, task);
}

TEST_P(BackendScroll, whatCannotBeIsRefused) {
    Field field = makeField(setupOf(small, FieldRules::measured));
    for (const int volume : {-1, 1})
        EXPECT_EQ(field.scroll(volume, {1, 0, 0}).error().code, ErrorCode::invalidArgument);
    // Where coordinates are too coarse for the spacing, as create() has it; and beyond what can be counted.
    for (const int far : {200'000, 1'000'000'000, 2'147'483'647})
        for (const int way : {far, -far})
            EXPECT_EQ(field.scroll(0, {0, 0, way}).error().code, ErrorCode::invalidArgument) << way;
    EXPECT_EQ(field.control().place(0), small) << "where it was";
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(field.scroll(0, {2'000, -2'000, 500}));
    ASSERT_TRUE(field.scroll(0, {-40'000, 40'000, -10'000}));
    EXPECT_EQ(field.control().place(0), small) << "and back, to the bit";
    // A field that converges stands still.
    const Scene scene = richScene();
    const ScenePose pose = poseAt(scene);
    const auto tracer = makeTracer(scene, pose);
    const FieldSnapshot before = field.read().value();
    int asked = 0;
    ASSERT_TRUE(field.converge(*tracer, {pose.lights, scene.sky}, 0.5f, 4, [&](const UpdateTimes&) {
        EXPECT_EQ(field.scroll(0, {1, 0, 0}).error().code, ErrorCode::invalidArgument);
        EXPECT_EQ(field.write(before).error().code, ErrorCode::invalidArgument);
        ++asked;
    }));
    EXPECT_GT(asked, 0);
}

}  // namespace
}  // namespace probegi::test
