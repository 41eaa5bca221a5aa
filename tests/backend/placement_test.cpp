// Relocation and probe states (DDGI paper, sections 5 and 6), on every backend.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "backend/every_backend.h"
#include "support/analytic_tracer.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;
constexpr glm::vec3 kPillarLower(2.3f, 0, 2.3f), kPillarUpper(5.4f, 9, 5.4f);

/// A hall of 12 x 9 x 12 m with a pillar and a lamp.
Scene hall() {
    Scene scene;
    scene.materials.push_back({.baseColor = {0.6f, 0.5f, 0.4f, 1.0f}});
    Primitive room, pillar;
    room.material = pillar.material = 0;
    addRoom(room, {0, 0, 0}, {12, 9, 12});
    addBox(pillar, kPillarLower, kPillarUpper);
    addObject(scene, std::move(room));
    addObject(scene, std::move(pillar));
    scene.lights.push_back({.type = LightType::point, .intensity = glm::vec3(9.0f)});
    scene.addNode({.translation = {7.3f, 4.6f, 7.1f}, .light = 0});
    return scene;
}

bool isInPillar(glm::vec3 p) {
    return p.x > kPillarLower.x && p.x < kPillarUpper.x && p.z > kPillarLower.z && p.z < kPillarUpper.z && p.y > 0 &&
           p.y < 9;
}

class BackendPlacement : public EveryBackend {
protected:
    FieldSetup setup(bool relocation, bool states) const {
        FieldSetup s;
        s.volumes = {{.origin = {0.5f, 0.5f, 0.5f}, .spacing = {1, 1, 1}, .counts = {12, 9, 12}}};
        s.raysPerProbe = 64;
        s.relocation = relocation;
        s.probeStates = states;
        return s;
    }
    void update(Field& field, int times = 1) const {
        for (int i = 0; i < times; ++i) {
            const auto done = field.update(*tracer, lighting);
            ASSERT_TRUE(done) << done.error().message;
        }
    }
    static int count(const Field& field, ProbeActivity activity) {
        int sum = 0;
        for (int slot = 0; slot < probeCount(field.desc()); ++slot) sum += field.control().activity(slot) == activity;
        return sum;
    }
    static std::set<std::uint32_t> taskSlots(const Field& field) {
        std::set<std::uint32_t> slots;
        for (const ProbeTask& task : field.control().tasks()) slots.insert(task.slot);
        return slots;
    }
    std::vector<FieldQuery> surfaces() const {
        std::vector<FieldQuery> points;
        const std::vector<FieldQuery> walls = wallPoints({{0, 0, 0}, {12, 9, 12}}, 6);
        points.insert(points.end(), walls.begin(), walls.end());
        for (float y = 0.7f; y < 9; y += 1.7f)
            for (float along = 2.5f; along < 5.4f; along += 0.6f) {
                points.push_back({{kPillarUpper.x, y, along}, {1, 0, 0}, {1, 0, 0}});
                points.push_back({{along, y, kPillarLower.z}, {0, 0, -1}, {0, 0, -1}});
            }
        return points;
    }

    const Scene scene = hall();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const std::unique_ptr<Tracer> tracer = GetParam().possible() ? makeTracer(scene, pose) : nullptr;
};
PROBEGI_ON_EVERY_BACKEND(BackendPlacement);

TEST_P(BackendPlacement, probesLeaveWallsOrTurnOff) {
    Field field = makeField(setup(true, true));
    EXPECT_EQ(count(field, ProbeActivity::uninitialized), probeCount(field.desc()));
    update(field);
    EXPECT_EQ(count(field, ProbeActivity::uninitialized), 0);
    int moved = 0, off = 0;
    for (int slot = 0; slot < probeCount(field.desc()); ++slot) {
        const glm::vec3 lattice = probePosition(field.desc().volumes[0], slot);
        const glm::vec3 place = field.control().probePosition(slot);
        const glm::vec3 way = glm::abs(place - lattice);
        ASSERT_LE(std::max({way.x, way.y, way.z}), 0.4501f) << slot;
        if (!isInPillar(lattice)) continue;
        const bool isOff = field.control().activity(slot) == ProbeActivity::off;
        // The pillar's probes are 0.2, 0.9 and 1.2 m from its faces: the outer ones can leave.
        EXPECT_EQ(isInPillar(place), isOff) << slot;
        isOff ? ++off : ++moved;
    }
    EXPECT_GT(moved, 10);
    EXPECT_GT(off, 5);
}

TEST_P(BackendPlacement, surfacesSeeWhatTheySeeWithAllAwake) {
    for (const bool relocation : {false, true}) {
        Field field = makeField(setup(relocation, true)), allAwake = makeField(setup(relocation, false));
        update(field, 6), update(allAwake, 6);
        EXPECT_EQ(allAwake.control().tasks().size(), std::size_t(probeCount(allAwake.desc())));
        EXPECT_LT(field.control().tasks().size(), allAwake.control().tasks().size() - 15);
        EXPECT_GT(count(field, ProbeActivity::sleeping), 10);
        const auto points = surfaces();
        const auto light = ask(field, points), same = ask(allAwake, points);
        double sum = 0, difference = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum += double(same[i].y);
            difference += double(std::abs(light[i].y - same[i].y));
        }
        EXPECT_GT(sum, 1);
        EXPECT_LT(difference, 0.005 * sum);
    }
}

TEST_P(BackendPlacement, whatMovesWakesProbesAndLetsThemSleepAgain) {
    Field field = makeField(setup(false, true));
    update(field, 3);
    const auto before = taskSlots(field);
    const std::uint32_t middle = 8 + 12 * (4 + 9 * 8);  // (8.5, 4.5, 8.5): in the air
    ASSERT_FALSE(before.contains(middle));
    const Bounds box{{8.3f, 4.3f, 8.3f}, {8.6f, 4.6f, 8.6f}};
    ASSERT_TRUE(field.control().setMoving({&box, 1}));
    EXPECT_EQ(field.control().activity(int(middle)), ProbeActivity::newlyAwake);
    EXPECT_TRUE(taskSlots(field).contains(middle)) << "the coming update has it";
    update(field);
    EXPECT_EQ(field.control().activity(int(middle)), ProbeActivity::awake);
    const FieldQuery onBox{{8.5f, 4.6f, 8.5f}, {0, 1, 0}, {0, 1, 0}};
    EXPECT_GT(field.irradiance(onBox).y, 0);
    const float fresh = probeIrradiance(field, int(middle), {0, 1, 0}).y;
    Field allAwake = makeField(setup(false, false));
    update(allAwake, 4);
    EXPECT_NEAR(fresh / probeIrradiance(allAwake, int(middle), {0, 1, 0}).y, 1, 0.5) << "its first update kept nothing";

    ASSERT_TRUE(field.control().setMoving({}));
    EXPECT_EQ(field.control().activity(int(middle)), ProbeActivity::sleeping);
    EXPECT_EQ(taskSlots(field), before);
    update(field);
    EXPECT_EQ(probeBackfaceShare(field, int(middle)), 2.0f) << "look-ups pass it over";
    ASSERT_TRUE(field.control().setMedia({&box, 1}));
    EXPECT_EQ(field.control().activity(int(middle)), ProbeActivity::newlyAwake) << "fog is asked for too";
}

// An engine that sets its bounds object by object, or clears them first, lets probes sleep between two updates only.
TEST_P(BackendPlacement, probesThatSleepBetweenUpdatesKeepWhatTheyKnow) {
    Field field = makeField(setup(false, true));
    const Bounds box{{8.3f, 4.3f, 8.3f}, {8.6f, 4.6f, 8.6f}};
    const int middle = 8 + 12 * (4 + 9 * 8);
    ASSERT_TRUE(field.control().setMoving({&box, 1}));
    update(field, 4);
    ASSERT_EQ(field.control().activity(middle), ProbeActivity::awake);
    const FieldSnapshot before = readProbe(field, middle);
    ASSERT_TRUE(field.control().setMoving({}));
    ASSERT_TRUE(field.control().setMoving({&box, 1}));
    EXPECT_EQ(field.control().activity(middle), ProbeActivity::awake);
    ASSERT_TRUE(field.control().setTasks(std::vector<std::uint32_t>{0}));
    update(field);
    const FieldSnapshot after = readProbe(field, middle);
    EXPECT_EQ(after.irradiance, before.irradiance) << "it was no task, and forgot nothing";
    EXPECT_EQ(after.states, before.states);
}

// A thing that stands on the floor while probes are placed, and goes.
TEST_P(BackendPlacement, surfacesUnderWhatMovesHaveProbesWhenItIsGone) {
    Field field = makeField(setup(true, true));
    const Bounds everything{glm::vec3(-100), glm::vec3(100)};
    ASSERT_TRUE(field.control().setMoving({&everything, 1}));
    update(field);
    ASSERT_TRUE(field.control().setMoving({}));
    update(field, 3);
    const auto points = surfaces();
    for (const glm::vec3& e : ask(field, points)) EXPECT_GT(e.y, 0);
}

TEST_P(BackendPlacement, aWriteOfSomeProbesLetsTheOthersForget) {
    Field field = makeField(setup(false, true));
    const Bounds box{{8.3f, 4.3f, 8.3f}, {8.6f, 4.6f, 8.6f}};
    const int middle = 8 + 12 * (4 + 9 * 8);
    ASSERT_TRUE(field.control().setMoving({&box, 1}));
    update(field, 2);
    const FieldSnapshot first = readProbe(field, 0);
    ASSERT_TRUE(field.control().setMoving({}));
    ASSERT_TRUE(field.write(first));
    update(field);
    EXPECT_EQ(probeBackfaceShare(field, middle), 2.0f) << "asleep";
}

TEST_P(BackendPlacement, aFieldWithoutStatesWakesTheSleepersOfASnapshot) {
    Field states = makeField(setup(true, true)), all = makeField(setup(true, false));
    update(states);
    ASSERT_TRUE(all.write(states.read().value()));
    EXPECT_EQ(all.control().tasks().size(), std::size_t(probeCount(all.desc())));
    update(all, 2);
    EXPECT_EQ(count(all, ProbeActivity::vigilant), probeCount(all.desc()));
    for (const glm::vec3& e : ask(all, surfaces())) EXPECT_GT(e.y, 0);
}

TEST_P(BackendPlacement, looksOfTheCallersRaysDoNotDisturbALaterPlacing) {
    Field field = makeField(setup(true, true)), traced = makeField(setup(true, true));
    const std::vector<RayDatum> air(field.control().tasks().size() * 64, RayDatum{glm::vec3(1), 1e30f});
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(field.update(air));
    update(field), update(traced);
    EXPECT_EQ(count(field, ProbeActivity::uninitialized), 0);
    for (int slot = 0; slot < probeCount(field.desc()); ++slot)
        EXPECT_EQ(field.control().activity(slot) == ProbeActivity::off,
                  traced.control().activity(slot) == ProbeActivity::off)
            << slot;
}

TEST_P(BackendPlacement, whereNoSurfaceIsThereIsNothingToConvergeTo) {
    FieldSetup s = setup(false, true);
    s.volumes[0] = {.origin = {4, 4, 8}, .spacing = {0.1f, 0.1f, 0.1f}, .counts = {4, 4, 4}};
    AnalyticTracer nothing;
    Field field = makeField(s);
    const auto done = field.converge(nothing, lighting, 0.1f, 20);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_TRUE(field.control().tasks().empty());
    EXPECT_TRUE(done->converged);
    EXPECT_EQ(done->remaining, 0.0f);
    EXPECT_LT(done->updates, 20);
}

// Surfaces that stand beyond a volume get the light of its nearest probes, which must not sleep.
TEST_P(BackendPlacement, surfacesBeyondTheVolumeKeepItsBorderAwake) {
    FieldSetup s = setup(false, true);
    s.volumes[0] = {.origin = {7, 3, 7}, .spacing = {0.5f, 0.5f, 0.5f}, .counts = {4, 4, 4}};
    Field field = makeField(s);
    update(field, 2);
    for (const FieldQuery& point : {FieldQuery{{8, 0, 8}, {0, 1, 0}, {0, 1, 0}}, {{12, 4, 8}, {-1, 0, 0}, {-1, 0, 0}}})
        EXPECT_GT(field.irradiance(point).y, 0);
}

TEST_P(BackendPlacement, boundsThatAreNoneAreRefused) {
    Field field = makeField(setup(false, true));
    const Bounds upsideDown{{1, 1, 1}, {0, 2, 2}}, infinite{{0, 0, 0}, {INFINITY, 1, 1}};
    EXPECT_EQ(field.control().setMoving({&upsideDown, 1}).error().code, ErrorCode::invalidArgument);
    EXPECT_EQ(field.control().setMedia({&infinite, 1}).error().code, ErrorCode::invalidArgument);
    const Bounds farAway{{1e6f, 0, 0}, {2e6f, 1, 1}}, everything{glm::vec3(-1e9f), glm::vec3(1e9f)};
    update(field);
    EXPECT_TRUE(field.control().setMoving({&farAway, 1}));
    EXPECT_EQ(count(field, ProbeActivity::newlyAwake), 0);
    EXPECT_TRUE(field.control().setMoving({&everything, 1}));
    EXPECT_EQ(count(field, ProbeActivity::sleeping), 0);
}

TEST_P(BackendPlacement, aWrittenFieldGoesOnAsTheOneThatWasRead) {
    Field field = makeField(setup(true, true));
    update(field, 3);
    const FieldSnapshot snapshot = field.read().value();
    Field second = makeField(setup(true, true));
    ASSERT_TRUE(second.write(snapshot));
    EXPECT_EQ(taskSlots(second), taskSlots(field));
    update(field, 2), update(second, 2);
    const FieldSnapshot a = field.read().value(), b = second.read().value();
    EXPECT_EQ(a.states, b.states);
    EXPECT_EQ(a.irradiance, b.irradiance);
    EXPECT_EQ(a.visibility, b.visibility);
    Field lattice = makeField(setup(false, false));
    EXPECT_EQ(lattice.write(snapshot).error().code, ErrorCode::invalidArgument) << "it has no offsets";
}

TEST_P(BackendPlacement, raysOfTheCallerPlaceProbesToo) {
    Field own = makeField(setup(true, true)), traced = makeField(setup(true, true));
    update(traced);
    const glm::vec3 up(0, 1, 0);
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(count(own, ProbeActivity::uninitialized), probeCount(own.desc())) << "update " << i;
        const auto tasks = own.control().tasks();
        std::vector<Ray> rays;
        for (const ProbeTask& task : tasks)
            for (const glm::vec3& direction : own.control().rayDirections())
                rays.push_back({task.origin, 0.0f, direction});
        std::vector<Hit> hits(rays.size());
        std::vector<Surface> seen(rays.size());
        ASSERT_TRUE(tracer->closestHits(rays, hits));
        ASSERT_TRUE(tracer->surfaces(rays, hits, seen));
        std::vector<RayDatum> data;
        for (std::size_t r = 0; r < rays.size(); ++r)
            data.push_back({glm::vec3(hits[r].valid() && !seen[r].backface ? 1.0f : 0.0f),
                            hits[r].valid() && seen[r].back ? -hits[r].distance : hits[r].distance});
        EXPECT_EQ(own.irradiance({{8.5f, 0, 8.5f}, up, up}).y, 0) << "no probe is placed yet";
        ASSERT_TRUE(own.update(data));
    }
    EXPECT_EQ(count(own, ProbeActivity::uninitialized), 0);
    // The rays are others: places agree where it matters.
    int same = 0, inPillar = 0;
    for (int slot = 0; slot < probeCount(own.desc()); ++slot) {
        const bool used = own.control().activity(slot) == ProbeActivity::newlyVigilant;
        same += used == (traced.control().activity(slot) == ProbeActivity::vigilant);
        inPillar += used && isInPillar(own.control().probePosition(slot));
    }
    EXPECT_GT(same, probeCount(own.desc()) * 9 / 10);
    EXPECT_EQ(inPillar, 0);
}

TEST_P(BackendPlacement, probesThatEnterAreNewAndPlacedWhereTheyStand) {
    Field field = makeField(setup(true, true));
    update(field);
    for (const glm::ivec3 step : {glm::ivec3(1, 0, -2), glm::ivec3(-40, 0, 0), glm::ivec3(38, 1, 2)}) {
        ASSERT_TRUE(field.scroll(0, step));
        const VolumeDesc place = field.control().place(0);
        EXPECT_GT(count(field, ProbeActivity::uninitialized), 0);
        update(field);
        FieldSetup inPlace = setup(true, true);
        inPlace.volumes = {place};
        Field made = makeField(inPlace);
        update(made);
        const FieldSnapshot scrolled = field.read().value();
        for (int number = 0; number < probeCount(place); ++number) {
            const int slot = scrolled.slotOf(0, number);
            EXPECT_LE(glm::distance(field.control().probePosition(slot), made.control().probePosition(number)), 0.012f)
                << number;
        }
    }
}

TEST_P(BackendPlacement, aConstantFieldIsConstantWhereverItsProbesStand) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> byte(-114, 114);
    for (const bool turned : {false, true}) {
        FieldSetup s = setup(true, false);
        if (turned) s.volumes[0].orientation = glm::normalize(glm::quat(0.9f, 0.2f, 0.3f, -0.1f));
        Field field = makeField(s);
        update(field);
        FieldSnapshot snapshot = field.read().value();
        const std::uint16_t half = 0x3c00;  // 1
        std::fill(snapshot.irradiance.begin(), snapshot.irradiance.end(), half);
        for (ProbeState& state : snapshot.states) {
            state.backfaceShare = 0;
            state.placement = std::uint32_t(ProbeActivity::vigilant);
            for (int axis = 1; axis < 4; ++axis) state.placement |= (std::uint32_t(byte(random)) & 0xffu) << 8 * axis;
        }
        ASSERT_TRUE(field.write(snapshot));
        for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
            changeSettings(field, [&](FieldSettings& set) { set.guard = guard; });
            for (const glm::vec3& e : ask(field, randomQueries(400))) EXPECT_NEAR(e.x, kPi, 2e-3f * kPi);
        }
    }
}

TEST_P(BackendPlacement, answersAreTheSameOnTheCpu) {
    FieldSetup s = setup(true, true);
    s.volumes[0].orientation = glm::normalize(glm::quat(0.97f, 0.0f, 0.2f, 0.1f));
    Field field = makeField(s), cpu = s.make(context).value();
    update(cpu, 3);
    ASSERT_TRUE(field.write(cpu.read().value()));
    std::vector<FieldQuery> points = surfaces();
    const auto more = randomQueries(300);
    points.insert(points.end(), more.begin(), more.end());
    const auto light = ask(field, points), same = ask(cpu, points);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LE(glm::length(light[i] - same[i]), 1e-3f * glm::length(same[i]) + 1e-4f) << i;
}

TEST_P(BackendPlacement, withoutEitherNothingChanges) {
    Field field = makeField(setup(false, false));
    EXPECT_EQ(count(field, ProbeActivity::vigilant), probeCount(field.desc()));
    const Bounds box{{7, 4, 7}, {8, 5, 8}};
    ASSERT_TRUE(field.control().setMoving({&box, 1}));
    update(field);
    EXPECT_EQ(count(field, ProbeActivity::vigilant), probeCount(field.desc()));
    for (int slot = 0; slot < 9; ++slot)
        EXPECT_EQ(field.control().probePosition(slot), probePosition(field.desc().volumes[0], slot));
}

}  // namespace
}  // namespace probegi::test
