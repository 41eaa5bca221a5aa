// Fields that were saved go on as if nothing had happened, on every backend.
#include <filesystem>

#include "backend/every_backend.h"
#include "backend/rich_scene.h"
#include "probegi/field_file.h"
#include "probegi/masks.h"

namespace probegi::test {
namespace {

class BackendFieldFile : public EveryBackend {
protected:
    BackendFieldFile() {
        setup.volumes = {offTheWalls(*placeVolume(pose.bounds, {.counts = {5, 4, 4}}))};
        setup.raysPerProbe = 48;
        setup.relocation = true;
        setup.probeStates = true;
    }
    ~BackendFieldFile() override { std::filesystem::remove(path); }

    void update(Field& field, int times) const {
        for (int i = 0; i < times; ++i) ASSERT_TRUE(field.update(*tracer, lighting));
    }
    Field loaded() const {
        const SavedField saved = made(loadField(path));
        FieldSetup own;
        static_cast<FieldDesc&>(own) = saved.snapshot.desc;
        static_cast<FieldSettings&>(own) = saved.settings;
        Field field = makeField(own);
        field.write(saved.snapshot).value();
        return field;
    }
    static void expectSame(const Field& one, const Field& other) {
        const FieldSnapshot a = one.read().value(), b = other.read().value();
        EXPECT_EQ(a.frame, b.frame);
        EXPECT_EQ(a.rayTurns, b.rayTurns);
        EXPECT_TRUE(a.irradiance == b.irradiance);
        EXPECT_TRUE(a.visibility == b.visibility);
        EXPECT_TRUE(a.states == b.states);
    }

    const Scene scene = richScene();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const std::unique_ptr<Tracer> tracer = makeTracer(scene, pose);
    FieldSetup setup;
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) /
        ("backend" +
         std::to_string(std::hash<std::string>{}(testing::UnitTest::GetInstance()->current_test_info()->name())) +
         ".field");
};
PROBEGI_ON_EVERY_BACKEND(BackendFieldFile);

TEST_P(BackendFieldFile, aLoadedFieldGoesOnAsTheOne) {
    Field one = makeField(setup);
    update(one, 3);
    ASSERT_TRUE(saveField(path, one));
    Field other = loaded();
    expectSame(one, other);
    update(one, 3);
    update(other, 3);
    expectSame(one, other);
}

TEST_P(BackendFieldFile, masksComeAlong) {
    Field first = makeField(setup);
    update(first, 1);
    std::vector<glm::vec3> positions;
    for (int slot = 0; slot < 80; ++slot) positions.push_back(first.control().probePosition(slot));
    const auto embree = made(makeEmbreeTracer(context, scene, pose));
    changeSettings(first, [&](FieldSettings& s) {
        s.guard = LeakGuard::masks;
        s.masks = made(bakeMasks(context, *embree, setup, {.factor = 4, .positions = positions}));
    });
    update(first, 2);
    ASSERT_TRUE(saveField(path, first));
    Field other = loaded();
    EXPECT_EQ(other.control().settings().guard, LeakGuard::masks);
    update(first, 2);
    update(other, 2);
    expectSame(first, other);
    const auto queries = randomQueries(200);
    EXPECT_EQ(ask(first, queries), ask(other, queries));
}

// Cut short after every so many updates, in the bounces and in the average, and taken up by another field.
TEST_P(BackendFieldFile, aConvergenceThatWasCutShortIsTakenUp) {
    constexpr float kTolerance = 0.02f;
    constexpr int kMost = 14;
    Field whole = makeField(setup);
    ConvergeState wholeState;
    int updates = 0;
    std::vector<SavedField> moments;
    const auto keep = [&](const UpdateTimes&) {
        if (++updates % 4 != 1) return;
        moments.push_back({whole.read().value(), whole.control().settings(), {}, wholeState});
    };
    const ConvergeResult result = made(whole.converge(*tracer, lighting, wholeState, kTolerance, kMost, keep));
    ASSERT_GE(moments.size(), 3u);
    Field plain = makeField(setup);
    EXPECT_EQ(made(plain.converge(*tracer, lighting, kTolerance, kMost)).updates, result.updates);
    expectSame(plain, whole);
    for (const SavedField& moment : moments) {
        ASSERT_TRUE(saveField(path, moment));
        Field other = loaded();
        ConvergeState state = made(loadField(path)).convergence;
        int further = 0;
        const auto count = [&](const UpdateTimes&) { ++further; };
        const ConvergeResult again = made(other.converge(*tracer, lighting, state, kTolerance, kMost, count));
        EXPECT_EQ(again.updates, result.updates);
        EXPECT_EQ(again.converged, result.converged);
        EXPECT_EQ(again.remaining, result.remaining);
        EXPECT_EQ(further, result.updates - moment.snapshot.frame);
        expectSame(other, whole);
        EXPECT_EQ(state.words, wholeState.words);
    }
    // One that has ended has nothing left to do.
    ConvergeState ended = wholeState;
    EXPECT_EQ(made(whole.converge(*tracer, lighting, ended, kTolerance, kMost)).remaining, result.remaining);
    EXPECT_EQ(ended.words, wholeState.words);
}

TEST_P(BackendFieldFile, aStateOfSomethingElseIsRefused) {
    Field field = makeField(setup);
    ConvergeState state;
    ASSERT_TRUE(field.converge(*tracer, lighting, state, 0.5f, 9));
    const FieldSnapshot before = field.read().value();
    const auto expectRefused = [&](std::vector<std::uint32_t> words) {
        ConvergeState bad{std::move(words)};
        const auto result = field.converge(*tracer, lighting, bad, 0.5f, 9);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
    };
    expectRefused({1, 2, 3});
    expectRefused({state.words.begin(), state.words.end() - 2});
    for (std::size_t at = 0; at < state.words.size(); ++at) {  // no word may do harm
        ConvergeState odd = state;
        odd.words[at] ^= 0x8000'0000u;
        (void)field.converge(*tracer, lighting, odd, 0.5f, 9);
        ASSERT_TRUE(field.write(before));
    }
    FieldSetup larger = setup;
    larger.volumes[0].counts.z = 6;
    Field other = makeField(larger);
    EXPECT_FALSE(other.converge(*tracer, lighting, state, 0.5f, 9));
}

}  // namespace
}  // namespace probegi::test
