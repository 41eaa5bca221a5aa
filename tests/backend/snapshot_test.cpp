// What a field's probes store, read and written, on every backend.
#include "backend/every_backend.h"
#include "backend/rich_scene.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

FieldSetup setupFor(const ScenePose& pose) {
    FieldSetup setup;
    setup.volumes = {offTheWalls(*placeVolume(pose.bounds, {.counts = {5, 4, 4}}))};
    setup.raysPerProbe = 48;
    return setup;
}

void expectSame(const FieldSnapshot& a, const FieldSnapshot& b) {
    EXPECT_EQ(a.slots, b.slots);
    EXPECT_EQ(a.frame, b.frame);
    EXPECT_EQ(a.rayTurns, b.rayTurns);
    EXPECT_TRUE(a.irradiance == b.irradiance);
    EXPECT_TRUE(a.visibility == b.visibility);
    EXPECT_TRUE(a.states == b.states);
}

class BackendSnapshot : public EveryBackend {
protected:
    void update(Field& field, int times) const {
        for (int i = 0; i < times; ++i) ASSERT_TRUE(field.update(*tracer, lighting));
    }

    const Scene scene = richScene();
    const ScenePose pose = poseAt(scene);
    const Lighting lighting{pose.lights, scene.sky};
    const FieldSetup setup = setupFor(pose);
    const std::unique_ptr<Tracer> tracer = makeTracer(scene, pose);
};
PROBEGI_ON_EVERY_BACKEND(BackendSnapshot);

TEST_P(BackendSnapshot, ofAFreshFieldIsBlack) {
    const FieldSnapshot fresh = makeField(setup).read().value();
    EXPECT_EQ(fresh.slots, (SlotRange{0, 80}));
    EXPECT_EQ(fresh.frame, 0);
    EXPECT_EQ(fresh.irradiance, std::vector<std::uint16_t>(80 * 3 * 64));
    EXPECT_EQ(fresh.visibility, std::vector<std::uint32_t>(80 * 256));
    EXPECT_EQ(fresh.states, std::vector<ProbeState>(80));
}

// All that an update reads is in it: else the two would part.
TEST_P(BackendSnapshot, aWrittenFieldGoesOnAsTheOne) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        FieldSetup own = setup;
        own.rules = rules;
        Field one = makeField(own), other = makeField(own);
        update(one, 4);
        const FieldSnapshot snapshot = one.read().value();
        EXPECT_EQ(snapshot.frame, 4);
        ASSERT_TRUE(other.write(snapshot));
        expectSame(other.read().value(), snapshot);
        EXPECT_TRUE(std::ranges::equal(one.control().rayDirections(), other.control().rayDirections()));
        const FieldQuery query{pose.bounds.centre(), {0, 1, 0}, {0, 1, 0}};
        EXPECT_EQ(one.irradiance(query), other.irradiance(query));
        update(one, 3);
        update(other, 3);
        const FieldSnapshot later = one.read().value();
        expectSame(other.read().value(), later);
        EXPECT_FALSE(later.irradiance == snapshot.irradiance);
    }
}

// converge() does not turn its rays in every update.
TEST_P(BackendSnapshot, afterConvergeTheRaysAreTheSameToo) {
    Field one = makeField(setup), other = makeField(setup);
    ASSERT_TRUE(one.converge(*tracer, lighting, 0.5f, 12));
    const FieldSnapshot snapshot = one.read().value();
    EXPECT_LT(snapshot.rayTurns, snapshot.frame);
    ASSERT_TRUE(other.write(snapshot));
    update(one, 1);
    update(other, 1);
    expectSame(other.read().value(), one.read().value());
}

TEST_P(BackendSnapshot, isTheSameOnAllBackends) {
    Field onCpu = made(kCpu.makeField(context, setup)), field = makeField(setup);
    const auto cpuTracer = made(kCpu.makeTracer(context, scene, pose));
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(onCpu.update(*cpuTracer, lighting));
    const FieldSnapshot snapshot = onCpu.read().value();
    ASSERT_TRUE(field.write(snapshot));
    expectSame(field.read().value(), snapshot);
    for (const FieldQuery& query : randomQueries(50)) {
        const glm::vec3 want = onCpu.irradiance(query), got = field.irradiance(query);
        EXPECT_LE(glm::length(got - want), 2e-3f * glm::length(want) + 1e-5f);
    }
}

TEST_P(BackendSnapshot, ofSomeSlotsLeavesTheOthers) {
    Field one = makeField(setup), other = makeField(setup);
    update(one, 3);
    update(other, 1);
    const FieldSnapshot before = other.read().value(), some = one.read({11, 5}).value();
    EXPECT_EQ(some.states.size(), 5u);
    ASSERT_TRUE(other.write(some));
    EXPECT_EQ(other.control().frame(), 3) << "the later of both";
    expectSame(other.read({11, 5}).value(), some);
    for (const int slot : {0, 10, 16, 79}) {
        const FieldSnapshot probe = other.read({slot, 1}).value();
        EXPECT_EQ(probe.states[0], before.state(slot)) << slot;
        EXPECT_TRUE(
            std::equal(probe.irradiance.begin(), probe.irradiance.end(), before.irradiance.begin() + slot * 3 * 64));
        EXPECT_TRUE(
            std::equal(probe.visibility.begin(), probe.visibility.end(), before.visibility.begin() + slot * 256));
    }
    // An earlier one does not turn time back.
    ASSERT_TRUE(other.write(makeField(setup).read({0, 2}).value()));
    EXPECT_EQ(other.control().frame(), 3);
    ASSERT_TRUE(other.write(other.read({80, 0}).value())) << "of no slots";
}

TEST_P(BackendSnapshot, whatDoesNotFitIsRefused) {
    Field field = makeField(setup);
    update(field, 1);
    const FieldSnapshot good = field.read().value();
    const auto refused = [&](const char* what, const auto& spoil) {
        FieldSnapshot bad = good;
        spoil(bad);
        const auto written = field.write(bad);
        ASSERT_FALSE(written) << what;
        EXPECT_EQ(written.error().code, ErrorCode::invalidArgument) << what;
        EXPECT_NE(written.error().message.find(what), std::string::npos) << written.error().message;
    };
    refused("other volumes", [](FieldSnapshot& s) { s.desc.volumes[0].spacing.y *= 1.5f; });
    refused("maps", [](FieldSnapshot& s) { s.desc.irradianceTexels = 6; });
    refused("from slot 1 on", [](FieldSnapshot& s) { s.slots.first = 1; });
    refused("irradiance has", [](FieldSnapshot& s) { s.irradiance.pop_back(); });
    refused("visibility has", [](FieldSnapshot& s) { s.visibility.push_back(0); });
    refused("states has", [](FieldSnapshot& s) { s.states.clear(); });
    refused("frame", [](FieldSnapshot& s) { s.rayTurns = s.frame + 1; });
    refused("frame", [](FieldSnapshot& s) { s.frame = s.rayTurns = -1; });
    refused("frame", [](FieldSnapshot& s) { s.frame = 2'147'483'647; });
    refused("how far they were scrolled", [](FieldSnapshot& s) { s.scrolled.clear(); });
    refused("too far", [](FieldSnapshot& s) { s.scrolled[0].y = -2'147'483'647 - 1; });
    refused("too coarse", [](FieldSnapshot& s) { s.scrolled[0].z = 900'000'000; });
    refused("maps", [](FieldSnapshot& s) { s.desc.visibilityTexels = 8; });
    refused("irradiance is not finite", [](FieldSnapshot& s) { s.irradiance[5] = 0x7c00; });
    refused("irradiance is not finite", [](FieldSnapshot& s) { s.irradiance[5] = 0x8001; });
    refused("probe state", [](FieldSnapshot& s) { s.states[3].backfaceShare = std::nanf(""); });
    refused("probe state", [](FieldSnapshot& s) { s.states[3].fronts = 1.5f; });
    refused("probe state", [](FieldSnapshot& s) { s.states[3].steps = 256; });
    refused("probe state", [](FieldSnapshot& s) { s.states[3].trust = 17; });
    refused("probe state", [](FieldSnapshot& s) { s.states[3].filter[5] = 0x7e000000u; });
    refused("probe state", [](FieldSnapshot& s) { s.states[3].filter[0] = 0x7e00u; });
    expectSame(field.read().value(), good);
    for (const SlotRange none :
         {SlotRange{-1, 2}, SlotRange{79, 2}, SlotRange{0, -1}, SlotRange{0x7fffffff, 0x7fffffff}})
        EXPECT_EQ(field.read(none).error().code, ErrorCode::invalidArgument);
}

}  // namespace
}  // namespace probegi::test
