// Several volumes in one field, and updates of some of its probes.
#include <glm/gtc/quaternion.hpp>

#include "backend/every_backend.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

constexpr float kPi = 3.14159265f;

VolumeDesc turnedVolume() {
    return {.origin = {4, 0.5f, -2},
            .spacing = {0.8f, 0.6f, 0.7f},
            .counts = {3, 5, 4},
            .orientation = glm::angleAxis(0.6f, glm::normalize(glm::vec3(1, 2, 0.5f)))};
}

FieldSetup withVolumes(std::vector<VolumeDesc> volumes) {
    FieldSetup setup = smallDesc();
    setup.volumes = std::move(volumes);
    return setup;
}

template <class T>
std::vector<T> joined(const std::vector<T>& a, const std::vector<T>& b) {
    std::vector<T> both = a;
    both.insert(both.end(), b.begin(), b.end());
    return both;
}

class BackendVolumes : public EveryBackend {
protected:
    // Whether a probe of one field stores what one of another does, bit for bit.
    static bool sameProbe(const Field& a, int slotA, const Field& b, int slotB) {
        const FieldSnapshot ofA = readProbe(a, slotA), ofB = readProbe(b, slotB);
        return ofA.states == ofB.states && ofA.irradiance == ofB.irradiance && ofA.visibility == ofB.visibility;
    }
};
PROBEGI_ON_EVERY_BACKEND(BackendVolumes);

TEST_P(BackendVolumes, twoVolumesWithOneBatchOfRaysAreTwoFields) {
    const FieldSetup first = smallDesc(), second = withVolumes({turnedVolume()});
    const FieldSetup both = withVolumes({first.volumes[0], second.volumes[0]});
    Field a = makeField(first), b = makeField(second), together = makeField(both);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        const auto raysA = randomData(first, 3 + frame), raysB = randomData(second, 50 + frame);
        const auto fixedA = randomFixedData(first, 7, 1.0f + float(frame)), fixedB = randomFixedData(second, 8, 1.0f);
        ASSERT_TRUE(a.update(raysA, fixedA));
        ASSERT_TRUE(b.update(raysB, fixedB));
        ASSERT_TRUE(together.update(joined(raysA, raysB), joined(fixedA, fixedB)));
    }
    const int ofA = probeCount(first), ofB = probeCount(second);
    ASSERT_EQ(probeCount(both), ofA + ofB);
    for (int probe = 0; probe < ofA; ++probe) EXPECT_TRUE(sameProbe(a, probe, together, probe)) << probe;
    for (int probe = 0; probe < ofB; ++probe) EXPECT_TRUE(sameProbe(b, probe, together, ofA + probe)) << probe;
    EXPECT_FALSE(sameProbe(a, 0, together, ofA)) << "the comparison can fail";
    // Points in one volume only are answered by it as if it were alone.
    const std::vector<FieldQuery> queries = randomQueries(1500);
    std::vector<FieldQuery> inFirst;
    const VolumeDesc& v = first.volumes[0];
    for (const FieldQuery& q : queries)
        if (glm::all(glm::greaterThan(q.position, v.origin)) &&
            glm::all(glm::lessThan(q.position, v.origin + v.spacing * glm::vec3(v.counts - 1))))
            inFirst.push_back(q);
    ASSERT_GT(inFirst.size(), 20u);
    // (A GPU's filter may round differently in an atlas of another size.)
    const auto alone = ask(a, inFirst), among = ask(together, inFirst);
    for (std::size_t i = 0; i < inFirst.size(); ++i) EXPECT_NEAR(among[i].x, alone[i].x, 1e-4f * alone[i].x) << i;
}

TEST_P(BackendVolumes, answersAreTheCpus) {
    const FieldSetup setup = withVolumes({smallDesc().volumes[0], turnedVolume()});
    Field field = makeField(setup), reference = made(kCpu.makeField(context, setup));
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        const auto rays = randomData(setup, 20 + frame);
        ASSERT_TRUE(field.update(rays));
        ASSERT_TRUE(reference.update(rays));
    }
    std::vector<FieldQuery> queries = randomQueries(1500);
    for (FieldQuery q : randomQueries(1500, 9)) {
        q.position = turnedVolume().origin + turnedVolume().orientation * (0.5f * q.position + 0.6f);
        queries.push_back(q);
    }
    const auto got = ask(field, queries), want = ask(reference, queries);
    double sum = 0, differs = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
        sum += want[i].x;
        differs += std::abs(got[i].x - want[i].x);
    }
    EXPECT_LT(differs, 1e-3 * sum);
}

// Each volume has its own light, from all sides: a point takes that of the volume around it, else of the nearest.
TEST_P(BackendVolumes, aPointIsAnsweredByItsVolume) {
    const VolumeDesc one{.origin = {0, 0, 0}, .spacing = glm::vec3(1), .counts = {3, 3, 3}};
    VolumeDesc two = turnedVolume();
    two.origin = {10, 0, 0};
    const FieldSetup setup = withVolumes({one, two});
    Field field = makeField(setup);
    std::vector<RayDatum> rays;
    for (const ProbeTask& task : field.control().tasks())
        rays.insert(rays.end(), std::size_t(setup.raysPerProbe), {glm::vec3(task.volume == 0 ? 1.0f : 4.0f), 50.0f});
    ASSERT_TRUE(field.update(rays));
    const auto e = [&](glm::vec3 position) { return field.irradiance({position, {0, 0, 1}}).x; };
    EXPECT_NEAR(e({1.2f, 0.7f, 1.5f}), kPi, 0.02f);
    EXPECT_NEAR(e({4, 1, 1}), kPi, 0.02f) << "nearest";
    EXPECT_NEAR(e(two.origin + two.orientation * glm::vec3(0.9f, 1.1f, 0.8f)), 4 * kPi, 0.05f);
    EXPECT_NEAR(e({20, 1, 1}), 4 * kPi, 0.05f) << "nearest";
}

// By the paper's rules a probe depends on its own rays alone.
TEST_P(BackendVolumes, anUpdateOfSomeProbesIsTheirsAlone) {
    FieldSetup setup = withVolumes({smallDesc().volumes[0], turnedVolume()});
    setup.rules = FieldRules::paper;
    Field field = makeField(setup), whole = makeField(setup), before = makeField(setup);
    const auto first = randomData(setup, 5), second = randomData(setup, 6);
    for (Field* f : {&field, &whole, &before}) ASSERT_TRUE(f->update(first));
    std::vector<std::uint32_t> slots;
    for (std::uint32_t slot = 3; slot < std::uint32_t(probeCount(setup)); slot += 7) slots.push_back(slot);
    std::swap(slots.front(), slots.back());  // any order
    std::vector<RayDatum> some;
    const std::size_t perProbe = std::size_t(setup.raysPerProbe);
    for (const std::uint32_t slot : slots)
        some.insert(some.end(), second.begin() + std::ptrdiff_t(slot * perProbe),
                    second.begin() + std::ptrdiff_t((slot + 1) * perProbe));
    ASSERT_TRUE(field.control().setTasks(slots));
    EXPECT_FALSE(field.update(second)) << "ray data of all probes are too many";
    ASSERT_TRUE(field.update(some));
    ASSERT_TRUE(whole.update(second));
    for (int slot = 0; slot < probeCount(setup); ++slot) {
        const bool chosen = slot % 7 == 3;
        EXPECT_TRUE(sameProbe(field, slot, chosen ? whole : before, slot)) << slot;
        EXPECT_FALSE(sameProbe(field, slot, chosen ? before : whole, slot)) << slot;
    }
    // And back to all of them.
    ASSERT_TRUE(field.control().setTasks({}));
    EXPECT_TRUE(field.update(randomData(setup, 7)));
}

// With windows of their own, probes that stand still keep what they know, and chosen ones follow the light.
TEST_P(BackendVolumes, chosenProbesFollowAndOthersStand) {
    const FieldSetup setup = withVolumes({smallDesc().volumes[0], turnedVolume()});
    Field field = makeField(setup);
    const auto fixedData = [&](std::size_t tasks, float scale) {
        return std::vector<FixedRayDatum>(tasks * std::size_t(setup.fixedRays), {scale, 0, 2.0f});
    };
    const std::size_t probes = std::size_t(probeCount(setup));
    for (int frame = 0; frame < 10; ++frame)
        ASSERT_TRUE(field.update(constantData(setup, glm::vec3(1), 2), fixedData(probes, 1)));
    const std::vector<std::uint32_t> slots{5, 6, 100, 130};
    ASSERT_TRUE(field.control().setTasks(slots));
    const std::vector<RayDatum> bright(slots.size() * std::size_t(setup.raysPerProbe), {glm::vec3(8), 2.0f});
    for (int frame = 0; frame < 4; ++frame) ASSERT_TRUE(field.update(bright, fixedData(slots.size(), 8)));
    for (int slot = 0; slot < int(probes); ++slot) {
        const bool chosen = std::count(slots.begin(), slots.end(), std::uint32_t(slot)) > 0;
        EXPECT_NEAR(probeIrradiance(field, slot, {0, 1, 0}).x / kPi, chosen ? 8.0f : 1.0f, chosen ? 0.8f : 0.01f)
            << slot;
    }
}

// A room with a lamp and two volumes in it, one of them turned.
struct TracedVolumes {
    explicit TracedVolumes(FieldRules rules)
        : scene(*makeBuiltinScene("cornell")), pose(poseAt(scene)), lighting{pose.lights, scene.sky} {
        const glm::vec3 size = pose.bounds.size();
        low = {.origin = pose.bounds.lower + 0.11f * size, .spacing = 0.21f * size, .counts = {4, 3, 4}};
        turned = {.origin = pose.bounds.centre(), .spacing = 0.09f * size, .counts = {3, 4, 3}};
        turned.orientation = glm::angleAxis(0.5f, glm::normalize(glm::vec3(0.3f, 1, 0.2f)));
        both = withVolumes({low, turned});
        both.rules = rules;
        both.raysPerProbe = 48;
    }
    FieldSetup only(const VolumeDesc& volume) const {
        FieldSetup setup = both;
        setup.volumes = {volume};
        return setup;
    }

    Scene scene;
    ScenePose pose;
    Lighting lighting;
    VolumeDesc low, turned;
    FieldSetup both;
};

// The library's own rays, looks at emitters included: the first update has no bounces, by which volumes would meet.
TEST_P(BackendVolumes, tracesEachVolumeAsIfItWereAlone) {
    const TracedVolumes s(FieldRules::measured);
    const auto tracer = makeTracer(s.scene, s.pose);
    Field a = makeField(s.only(s.low)), b = makeField(s.only(s.turned)), together = makeField(s.both);
    for (Field* f : {&a, &b, &together}) ASSERT_TRUE(f->update(*tracer, s.lighting));
    const int ofA = probeCount(s.low);
    for (int probe = 0; probe < ofA; ++probe) EXPECT_TRUE(sameProbe(a, probe, together, probe)) << probe;
    for (int probe = 0; probe < probeCount(s.turned); ++probe)
        EXPECT_TRUE(sameProbe(b, probe, together, ofA + probe)) << probe;
}

TEST_P(BackendVolumes, tracesChosenProbesAndConvergesAll) {
    const TracedVolumes s(FieldRules::paper);
    const auto tracer = makeTracer(s.scene, s.pose);
    Field field = makeField(s.both), whole = makeField(s.both), black = makeField(s.both);
    const std::vector<std::uint32_t> slots{40, 3, 50, 17, 61};
    ASSERT_TRUE(field.control().setTasks(slots));
    ASSERT_TRUE(field.update(*tracer, s.lighting));
    ASSERT_TRUE(whole.update(*tracer, s.lighting));
    const auto isChosen = [&](int slot) { return std::count(slots.begin(), slots.end(), std::uint32_t(slot)) > 0; };
    for (int slot = 0; slot < probeCount(s.both); ++slot)
        EXPECT_TRUE(sameProbe(field, slot, isChosen(slot) ? whole : black, slot)) << slot;
    // An average is about all probes; afterwards the chosen ones are updated again, and no others.
    ASSERT_TRUE(field.converge(*tracer, s.lighting, 1e-6f, 6));
    for (int slot = 0; slot < probeCount(s.both); ++slot) EXPECT_FALSE(sameProbe(field, slot, black, slot)) << slot;
    ASSERT_EQ(field.control().tasks().size(), slots.size());
    const glm::vec3 up(0, 1, 0);
    std::vector<float> before;
    for (int slot = 0; slot < probeCount(s.both); ++slot) before.push_back(probeIrradiance(field, slot, up).x);
    ASSERT_TRUE(field.update(*tracer, s.lighting));
    int moved = 0;
    for (int slot = 0; slot < probeCount(s.both); ++slot) {
        const bool same = probeIrradiance(field, slot, up).x == before[std::size_t(slot)];
        EXPECT_TRUE(same || isChosen(slot)) << slot;
        moved += same ? 0 : 1;
    }
    EXPECT_GE(moved, 3) << "of five; one may stand where nothing changes upwards";
}

}  // namespace
}  // namespace probegi::test
