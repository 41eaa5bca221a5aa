// Events in boxes (DDGI paper, section 4.3): the probes inside follow faster, an update leaves all others bit for bit
// as they would be without. (Later they hear of it by light and through what their neighbours see.)
#include "backend/every_backend.h"
#include "support/probes.h"

namespace probegi::test {
namespace {

class BackendEvents : public EveryBackend {
protected:
    static FieldSetup setupOf(FieldRules rules) {
        FieldSetup setup = smallDesc();
        setup.rules = rules;
        return setup;
    }
    /// Random light that jumps to half after update 6, where `told` is called.
    template <class Told>
    FieldSnapshot afterAJump(const FieldSetup& setup, const Told& told, int updates = 1) const {
        Field field = makeField(setup);
        const auto update = [&](std::uint32_t seed, float scale) {
            std::vector<RayDatum> data = randomData(setup, seed);
            for (RayDatum& d : data) d.radiance *= scale;
            // Light of the fixed rays is the same throughout: what is not told of goes unnoticed.
            const auto fixed =
                setup.rules == FieldRules::paper ? std::vector<FixedRayDatum>() : randomFixedData(setup, 1, 1.0f);
            const auto done = field.update(data, fixed);
            ASSERT_TRUE(done) << done.error().message;
        };
        for (std::uint32_t i = 0; i < 30; ++i) update(i, 1.0f);
        told(field.control());
        for (int i = 0; i < updates; ++i) update(100 + std::uint32_t(i), 0.5f);
        return made(field.read());
    }
    std::vector<FieldSnapshot> m_snapshots;

    static bool sameProbe(const FieldSnapshot& a, const FieldSnapshot& b, std::size_t i) {
        const std::size_t texels = a.irradiance.size() / a.states.size(),
                          moments = a.visibility.size() / a.states.size();
        const auto same = [&](const auto& x, const auto& y, std::size_t each) {
            return std::equal(x.begin() + std::ptrdiff_t(i * each), x.begin() + std::ptrdiff_t((i + 1) * each),
                              y.begin() + std::ptrdiff_t(i * each));
        };
        return same(a.irradiance, b.irradiance, texels) && same(a.visibility, b.visibility, moments) &&
               a.states[i] == b.states[i];
    }
};
PROBEGI_ON_EVERY_BACKEND(BackendEvents);

bool isInside(const Bounds& box, glm::vec3 p) {
    for (int axis = 0; axis < 3; ++axis)
        if (p[axis] < box.lower[axis] || p[axis] > box.upper[axis]) return false;
    return true;
}

TEST_P(BackendEvents, reachTheProbesInTheBoxAndNoOthers) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        const FieldSetup setup = setupOf(rules);
        const VolumeDesc& volume = setup.volumes[0];
        // From the first corner past the middle of each axis; its upper faces pass through probes.
        const Bounds box{probePosition(volume, 0) - 0.1f, probePosition(volume, 3 + 6 * (2 + 4 * 2))};
        const FieldSnapshot untold = afterAJump(setup, [](FieldControl&) {});
        const FieldSnapshot told =
            afterAJump(setup, [&](FieldControl& control) { control.notify(FieldEvent::largeObjectChange, box); });
        int inside = 0;
        for (int slot = 0; slot < probeCount(setup); ++slot) {
            const bool same = sameProbe(told, untold, std::size_t(slot));
            const bool within = isInside(box, probePosition(volume, slot));
            EXPECT_NE(same, within) << slot;
            inside += within ? 1 : 0;
        }
        EXPECT_EQ(inside, 4 * 3 * 3);
    }
}

// A box around everything is the event without a box.
TEST_P(BackendEvents, aBoxAroundAllProbesIsNoBox) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        const FieldSetup setup = setupOf(rules);
        const Bounds all{glm::vec3(-1e6f), glm::vec3(1e6f)};
        for (const FieldEvent event : {FieldEvent::smallLightChange, FieldEvent::largeLightChange,
                                       FieldEvent::largeObjectChange, FieldEvent::smallObjectChange}) {
            const FieldSnapshot boxed = afterAJump(setup, [&](FieldControl& control) { control.notify(event, all); });
            const FieldSnapshot plain = afterAJump(setup, [&](FieldControl& control) { control.notify(event); });
            const FieldSnapshot untold = afterAJump(setup, [](FieldControl&) {});
            EXPECT_EQ(boxed.irradiance, plain.irradiance) << int(event);
            EXPECT_EQ(boxed.visibility, plain.visibility) << int(event);
            EXPECT_NE(boxed.irradiance, untold.irradiance) << int(event);
            const bool object = event == FieldEvent::largeObjectChange || event == FieldEvent::smallObjectChange;
            EXPECT_NE(boxed.visibility == untold.visibility, object);
        }
    }
}

// A list of tasks has its probes in any order; events go by their place all the same.
TEST_P(BackendEvents, reachChosenTasksByTheirPlace) {
    const FieldSetup setup = setupOf(FieldRules::measured);
    const VolumeDesc& volume = setup.volumes[0];
    const std::vector<std::uint32_t> slots{50, 3, 17, 90, 4};
    const Bounds box{probePosition(volume, 17) - 0.01f, probePosition(volume, 17) + 0.01f};
    const auto run = [&](bool told) {
        Field field = makeField(setup);
        const auto update = [&](std::uint32_t seed, float scale) {
            FieldSetup few = setup;
            few.volumes[0].counts = {int(field.control().tasks().size()), 1, 1};
            std::vector<RayDatum> data = randomData(few, seed);
            for (RayDatum& d : data) d.radiance *= scale;
            // Fixed rays that see no change, whichever probes are the tasks.
            const std::vector<FixedRayDatum> fixed(std::size_t(probeCount(few) * few.fixedRays), {1.0f, 0.3f, 1.0f});
            ASSERT_TRUE(field.update(data, fixed));
        };
        for (std::uint32_t i = 0; i < 20; ++i) update(i, 1.0f);
        ASSERT_TRUE(field.control().setTasks(slots));
        if (told) field.control().notify(FieldEvent::largeLightChange, box);
        update(50, 0.5f);
        m_snapshots.push_back(made(field.read()));
    };
    run(false);
    run(true);
    for (int slot = 0; slot < probeCount(setup); ++slot)
        EXPECT_NE(sameProbe(m_snapshots[0], m_snapshots[1], std::size_t(slot)), slot == 17) << slot;
}

// The same events, the same light on every backend.
TEST_P(BackendEvents, agreeWithTheCpu) {
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper}) {
        const FieldSetup setup = setupOf(rules);
        Field field = makeField(setup), cpu = made(kCpu.makeField(context, setup));
        const VolumeDesc& volume = setup.volumes[0];
        const Bounds box{probePosition(volume, 0) - 0.1f, probePosition(volume, 3 + 6 * (2 + 4 * 2))};
        for (std::uint32_t i = 0; i < 8; ++i)
            for (Field* f : {&field, &cpu}) {
                if (i == 4) f->control().notify(FieldEvent::largeObjectChange, box);
                const auto fixed =
                    rules == FieldRules::paper ? std::vector<FixedRayDatum>() : randomFixedData(setup, i, 1.0f);
                ASSERT_TRUE(f->update(randomData(setup, i), fixed));
            }
        expectSameAtlases(field, cpu);
    }
}

}  // namespace
}  // namespace probegi::test
