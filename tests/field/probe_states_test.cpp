#include "field/probe_states.h"

#include <gtest/gtest.h>

#include "field/layout.h"
#include "kernels/probe/probe_state.h"
#include "kernels/probe/relocation.h"

namespace probegi {
namespace {

FieldDesc desc(bool relocation, bool states) {
    FieldDesc d;
    d.volumes = {{.origin = {0, 0, 0}, .spacing = {1, 1, 1}, .counts = {8, 4, 4}}};
    d.relocation = relocation;
    d.probeStates = states;
    return d;
}

/// Words of probes after all of their looks.
std::vector<std::uint32_t> looked(const FieldDesc& d, bool inside) {
    const std::uint32_t word =
        kernels::looksOfPlacement(d.relocation) * kernels::kOneLook + (inside ? kernels::kInsideBit : 0u);
    return std::vector<std::uint32_t>(std::size_t(probeCount(d)), word);
}

TEST(ProbeStates, aFieldWithoutThemHasNothingToPlaceOrTell) {
    ProbeStates states(desc(false, false));
    EXPECT_FALSE(states.hasNew());
    EXPECT_FALSE(states.changed());
    EXPECT_TRUE(states.allAreTasks());
    states.enter(makeVolumes(desc(false, false))[0], {3, 0, 0});
    EXPECT_FALSE(states.changed());
}

TEST(ProbeStates, placingTellsWhoIsOffAsleepOrVigilant) {
    const FieldDesc d = desc(false, true);
    for (const bool inside : {false, true})
        for (const bool used : {false, true}) {
            ProbeStates states(d);
            std::vector<std::uint8_t> surfaces(128, std::uint8_t(used));
            states.placed(looked(d, inside), surfaces);
            EXPECT_FALSE(states.hasNew());
            const std::uint32_t expected = inside ? kernels::kOff : used ? kernels::kNewlyVigilant : kernels::kSleeping;
            EXPECT_EQ(states.placements()[5], expected) << "and nothing of the looks is left in it";
            EXPECT_EQ(states.isTask(5), expected == kernels::kNewlyVigilant);
        }
}

TEST(ProbeStates, withoutStatesAllArePlacedAndUpdated) {
    const FieldDesc d = desc(true, false);
    ProbeStates states(d);
    states.placed(looked(d, true), std::vector<std::uint8_t>(128));
    EXPECT_TRUE(states.allAreTasks());
    EXPECT_EQ(kernels::stateOf(states.placements()[0]), kernels::kNewlyVigilant);
}

TEST(ProbeStates, aLookThatIsNotTheLastPlacesNobody) {
    const FieldDesc d = desc(true, true);
    ProbeStates states(d);
    std::vector<std::uint8_t> surfaces(128);
    surfaces[7] = 1;
    std::vector<std::uint32_t> words(128, kernels::kOneLook);
    states.placed(words, surfaces);
    EXPECT_TRUE(states.hasNew());
    EXPECT_TRUE(states.isTask(7)) << "whoever traces the rays must trace them";
    states.told();
    words = std::vector<std::uint32_t>(states.placements().begin(), states.placements().end());
    for (std::uint32_t& word : words) word += (kernels::looksOfPlacement(true) - 1) * kernels::kOneLook;
    states.placed(words, std::vector<std::uint8_t>(128));
    EXPECT_EQ(states.placements()[7], kernels::kNewlyVigilant) << "an earlier look found its surface";
    EXPECT_EQ(states.placements()[8], kernels::kSleeping);
}

TEST(ProbeStates, laterRaysWakeSleepers) {
    const FieldDesc d = desc(false, true);
    ProbeStates states(d);
    states.placed(looked(d, false), std::vector<std::uint8_t>(128));
    states.told();
    std::vector<std::uint8_t> surfaces(128);
    surfaces[3] = 1;
    const std::vector<std::uint32_t> words(states.placements().begin(), states.placements().end());
    states.placed(words, surfaces);
    EXPECT_EQ(states.placements()[3], kernels::kNewlyVigilant);
    EXPECT_TRUE(states.changed());
    EXPECT_TRUE(states.renewed().empty()) << "it knows nothing as it is";
    const ProbeTask task{{}, 3, 0};
    states.updated({&task, 1});
    EXPECT_EQ(states.placements()[3], kernels::kVigilant);
}

TEST(ProbeStates, moversReachTheProbesThatTheirSurfacesUse) {
    const FieldDesc d = desc(false, true);
    const auto volumes = makeVolumes(d);
    for (const FieldRules rules : {FieldRules::paper, FieldRules::measured}) {
        ProbeStates states(d);
        states.placed(looked(d, false), std::vector<std::uint8_t>(128));
        const Bounds point{{3.5f, 1, 1}, {3.5f, 1, 1}};
        states.watch({&point, 1}, {});
        states.wake(volumes, {}, rules);
        // A cell and eq. 2's bias, 0.225 of a spacing; by the measured rules a layer more and 0.44.
        const int reach = rules == FieldRules::paper ? 1 : 2;
        for (int x = 0; x < 8; ++x)
            EXPECT_EQ(states.isTask(std::size_t(x + 8 * (1 + 4))), std::abs(2 * x - 7) <= 2 * reach + 0) << x;
        states.watch({}, {});
        states.wake(volumes, {}, rules);
        EXPECT_FALSE(states.isTask(8 * (1 + 4) + 3));
    }
}

TEST(ProbeStates, probesThatEnterAreNew) {
    const FieldDesc d = desc(true, true);
    ProbeStates states(d);
    states.placed(looked(d, false), std::vector<std::uint8_t>(128, 1));
    std::vector<glm::ivec3> scrolled{{2, 0, 0}};
    const auto volumes = makeVolumes(d, scrolled);
    states.enter(volumes[0], {2, 0, 0});
    int fresh = 0;
    for (std::size_t slot = 0; slot < 128; ++slot) fresh += states.isNew(slot);
    EXPECT_EQ(fresh, 2 * 4 * 4);
    EXPECT_TRUE(states.isNew(std::size_t(kernels::probeSlot(volumes[0], {7, 0, 0}))));
    EXPECT_FALSE(states.isNew(std::size_t(kernels::probeSlot(volumes[0], {5, 0, 0}))));
}

}  // namespace
}  // namespace probegi
