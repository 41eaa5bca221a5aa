// Updates with a budget: what backends report, and that they are asked for the same probes.
#include "backend/every_backend.h"
#include "field/control_impl.h"
#include "field/field_backend.h"

namespace probegi::test {
namespace {

class BackendBudget : public EveryBackend {
protected:
    static UpdateBudget probes(const FieldDesc& desc, int count) {
        const bool paper = desc.rules == FieldRules::paper;
        UpdateBudget budget;
        budget.rays = std::int64_t(count) * (desc.raysPerProbe + (paper ? 0 : desc.fixedRays + desc.emitterSamples));
        return budget;
    }
    /// An update by random data, of which each probe gets its own whatever the tasks are.
    static void update(Field& field, std::uint32_t seed, float scale) {
        const FieldDesc& desc = field.desc();
        const auto rays = std::size_t(desc.raysPerProbe), fixed = std::size_t(desc.fixedRays);
        const std::vector<RayDatum> all = randomData(desc, seed);
        const std::vector<FixedRayDatum> allFixed = randomFixedData(desc, 1, scale);
        std::vector<RayDatum> data;
        std::vector<FixedRayDatum> fixedData;
        for (const ProbeTask& task : field.control().tasks()) {
            const auto first = all.begin() + std::ptrdiff_t(task.slot * rays);
            data.insert(data.end(), first, first + std::ptrdiff_t(rays));
            const auto firstFixed = allFixed.begin() + std::ptrdiff_t(task.slot * fixed);
            fixedData.insert(fixedData.end(), firstFixed, firstFixed + std::ptrdiff_t(fixed));
        }
        if (desc.rules == FieldRules::paper) fixedData.clear();
        const auto done = field.update(data, fixedData);
        ASSERT_TRUE(done) << done.error().message;
    }
    static std::vector<std::uint32_t> slotsOf(const Field& field) {
        std::vector<std::uint32_t> slots;
        for (const ProbeTask& task : field.control().tasks()) slots.push_back(task.slot);
        return slots;
    }
};
PROBEGI_ON_EVERY_BACKEND(BackendBudget);

TEST_P(BackendBudget, probesTellTheSameAsOnTheCpu) {
    const FieldSetup setup = smallDesc();
    Field field = makeField(setup), reference = kCpu.makeField(context, setup).value();
    for (Field* each : {&field, &reference}) {
        each->control().setBudget(probes(setup, probeCount(setup))).value();
        for (std::uint32_t i = 0; i < 6; ++i) update(*each, i, i < 5 ? 1.0f : 1.5f);
    }
    const auto got = backendOf(field).progress(), wanted = backendOf(reference).progress();
    ASSERT_EQ(wanted.size(), std::size_t(probeCount(setup)));
    ASSERT_EQ(got.size(), wanted.size());
    int changed = 0, noisy = 0;
    for (std::size_t slot = 0; slot < wanted.size(); ++slot) {
        EXPECT_NEAR(got[slot].lag, wanted[slot].lag, 2e-2f) << slot;
        EXPECT_NEAR(got[slot].noise, wanted[slot].noise, 1e-2f * wanted[slot].noise + 1e-4f) << slot;
        EXPECT_NEAR(got[slot].confidence, wanted[slot].confidence, 1e-3f) << slot;
        changed += wanted[slot].lag > 0.2f;
        noisy += wanted[slot].noise > 0.01f;
    }
    EXPECT_GT(changed, 100) << "light is half as bright again";
    EXPECT_GT(noisy, 100);
}

TEST_P(BackendBudget, withoutABudgetNothingIsReported) {
    const FieldSetup setup = smallDesc();
    Field field = makeField(setup);
    update(field, 1, 1.0f);
    EXPECT_TRUE(backendOf(field).progress().empty());
}

// What the books decide - turns, the camera, events - is the same everywhere; and so is the light that follows.
TEST_P(BackendBudget, tasksAndLightAreTheSameAsOnTheCpu) {
    FieldSetup setup = smallDesc();
    setup.rules = FieldRules::paper;
    setup.camera = glm::vec3(0, 0, 0);
    Field field = makeField(setup), reference = kCpu.makeField(context, setup).value();
    for (Field* each : {&field, &reference}) each->control().setBudget(probes(setup, 40)).value();
    for (std::uint32_t i = 0; i < 12; ++i) {
        if (i == 6)
            for (Field* each : {&field, &reference})
                each->control().notify(FieldEvent::largeObjectChange, {glm::vec3(-1), glm::vec3(0.5f)});
        ASSERT_EQ(slotsOf(field), slotsOf(reference)) << i;
        EXPECT_EQ(slotsOf(field).size(), 40u);
        for (Field* each : {&field, &reference}) update(*each, i, 1.0f);
    }
    expectSameAtlases(field, reference);
}

TEST_P(BackendBudget, eventsReachTheProbesOfABudgetAsOnTheCpu) {
    const FieldSetup setup = smallDesc();
    Field field = makeField(setup), reference = kCpu.makeField(context, setup).value(),
          deaf = kCpu.makeField(context, setup).value();
    for (Field* each : {&field, &reference, &deaf}) {
        each->control().setBudget(probes(setup, probeCount(setup))).value();
        for (std::uint32_t i = 0; i < 5; ++i) update(*each, i, 1.0f);
        if (each != &deaf) each->control().notify(FieldEvent::largeObjectChange, {glm::vec3(-1), glm::vec3(0.5f)});
        for (std::uint32_t i = 5; i < 7; ++i) update(*each, i, 1.0f);
    }
    expectSameAtlases(field, reference);
    EXPECT_GT(compareAtlases(deaf, reference).worstIrradiance, 2) << "more than backends may differ";
}

}  // namespace
}  // namespace probegi::test
