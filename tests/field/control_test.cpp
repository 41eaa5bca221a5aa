// The UpdateFrame that a field's control makes for the next update.
#include "field/control_impl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "kernels/trace/ray_set.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

FieldSetup smallDesc(FieldRules rules = FieldRules::measured) {
    FieldSetup d;
    d.raysPerProbe = 20;
    d.fixedRays = 12;
    d.hysteresis = 0.9f;
    d.visibilityHysteresis = 0.8f;
    d.rules = rules;
    return d;
}

struct Books : FieldControl::Impl {
    explicit Books(const FieldSetup& setup) : Impl(setup, setup) {}
};

TEST(FieldControl, thePapersRaysAreTheFibonacciSetTurned) {
    Books books(smallDesc(FieldRules::paper));
    ASSERT_EQ(books.directions.size(), 20u);
    const std::vector<glm::vec3> first(books.directions.begin(), books.directions.end());
    books.advance();
    EXPECT_NE(books.directions[0], first[0]);
    for (std::uint32_t i = 1; i < 20; ++i) {
        const float angle = glm::dot(kernels::sphericalFibonacci(0, 20), kernels::sphericalFibonacci(i, 20));
        EXPECT_NEAR(glm::dot(first[0], first[i]), angle, 1e-5f);
        EXPECT_NEAR(glm::dot(books.directions[0], books.directions[i]), angle, 1e-5f);
    }
}

TEST(FieldControl, anAverageHasThePapersRays) {
    Books books(smallDesc()), paper(smallDesc(FieldRules::paper));
    const glm::vec3 shifted = books.directions[3];
    books.setAveraging(true);
    EXPECT_EQ(books.directions[3], paper.directions[3]);
    books.advance(), paper.advance();
    EXPECT_EQ(books.directions[3], paper.directions[3]);
    books.advance(false);
    EXPECT_EQ(books.directions[3], paper.directions[3]) << "the same rays again";
    Books again(smallDesc());
    again.setAveraging(true);
    again.setAveraging(false);
    EXPECT_EQ(again.directions[3], shifted);
}

// Each ray stays in its own band of equal area about one axis: after many updates, all heights are equally frequent.
TEST(FieldControl, raysAreShiftedEvenlyOverTheirBands) {
    FieldSetup desc = smallDesc();
    desc.raysPerProbe = 144;
    Books books(desc);
    const glm::mat3 back = glm::transpose(kernels::frameRotation(kernels::hashCombine(1u, 0u), 0u));
    constexpr int kFrames = 200;
    std::vector<float> heights;
    for (int frame = 0; frame < kFrames; ++frame, books.advance())
        for (int i = 0; i < 144; ++i) {
            const glm::vec3 d = back * books.directions[std::size_t(i)];
            EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
            const float inBand = (1 - d.z) * 72 - float(i);
            EXPECT_TRUE(inBand > -1e-3f && inBand < 1.001f) << i << " of update " << frame;
            if (i == 7) heights.push_back(inBand);
        }
    std::sort(heights.begin(), heights.end());
    for (int k = 0; k < kFrames; ++k)
        EXPECT_NEAR(heights[std::size_t(k)], (float(k) + 0.5f) / kFrames, 0.03f) << "random ones deviate by 0.1";
}

TEST(FieldControl, fixedRaysStandStillAndThePaperHasNone) {
    Books books(smallDesc());
    books.advance();
    ASSERT_EQ(books.fixedDirections.size(), 12u);
    for (std::uint32_t i = 0; i < 12; ++i) EXPECT_EQ(books.fixedDirections[i], kernels::sphericalFibonacci(i, 12));
    EXPECT_TRUE(Books(smallDesc(FieldRules::paper)).fixedDirections.empty());
}

TEST(FieldControl, theMeasuredRulesHaveWindows) {
    Books books(smallDesc());
    const UpdateFrame first = books.comingUpdate();
    EXPECT_TRUE(first.windows && first.linear);
    EXPECT_FALSE(first.bounces);
    EXPECT_EQ(first.directions.size(), 20u);
    EXPECT_EQ(first.fixedDirections.size(), 12u);
    EXPECT_EQ(first.longestWindow, 200.0f);
    books.advance();
    EXPECT_EQ(books.frame, 1);
    EXPECT_TRUE(books.comingUpdate().bounces);
    EXPECT_EQ(first.longestVisibilityWindow, 100.0f);
    EXPECT_NE(books.comingUpdate().ditherSeed, first.ditherSeed);
    EXPECT_NE(books.comingUpdate().raySeed, first.raySeed);
    EXPECT_NE(first.raySeed, first.ditherSeed);
}

// Without fixed rays a change cannot be detected: old light fades at the described rate, also after an event.
TEST(FieldControl, withoutFixedRaysTheHysteresisIsTheLongestWindow) {
    Books books(smallDesc());
    books.advance();
    const UpdateFrame without = books.comingUpdateWithoutFixedRays();
    EXPECT_TRUE(without.windows);
    EXPECT_TRUE(without.fixedDirections.empty());
    EXPECT_NEAR(without.longestWindow, 10.0f, 1e-4f);
    EXPECT_NEAR(without.longestVisibilityWindow, 5.0f, 1e-4f) << "1 / (1 - 0.8)";
    FieldSetup none = smallDesc();
    none.fixedRays = 0;
    Books bare(none);
    bare.advance();
    EXPECT_NEAR(bare.comingUpdate().longestWindow, 10.0f, 1e-4f);
    EXPECT_NEAR(bare.comingUpdate().longestVisibilityWindow, 5.0f, 1e-4f);
    books.events.notify(FieldEvent::largeLightChange);
    EXPECT_NEAR(books.comingUpdate().longestWindow, 1 / (1 - 0.45f), 1e-4f);
    EXPECT_EQ(books.comingUpdate().longestVisibilityWindow, 100.0f) << "light changes no distance";
    books.events.notify(FieldEvent::largeObjectChange);
    EXPECT_NEAR(books.comingUpdate().longestVisibilityWindow, 1 / (1 - 0.4f), 1e-4f);
    EXPECT_EQ(books.comingUpdate().fixedDirections.size(), 12u);
}

TEST(FieldControl, thePaperHasItsHysteresis) {
    Books books(smallDesc(FieldRules::paper));
    EXPECT_EQ(books.comingUpdate().hysteresis.irradiance, 0.0f);
    books.advance();
    const UpdateFrame frame = books.comingUpdate();
    EXPECT_FALSE(frame.windows || frame.linear);
    EXPECT_TRUE(frame.fixedDirections.empty());
    EXPECT_EQ(frame.hysteresis.irradiance, 0.9f);
    EXPECT_EQ(frame.hysteresis.visibility, 0.8f);
}

TEST(FieldControl, averagesKeepTheGivenShare) {
    Books books(smallDesc());
    const UpdateFrame frame = books.comingAverage({0.3f, 0.6f});
    EXPECT_TRUE(frame.linear);
    EXPECT_FALSE(frame.windows);
    EXPECT_TRUE(frame.fixedDirections.empty());
    EXPECT_EQ(frame.hysteresis.irradiance, 0.3f);
    EXPECT_EQ(frame.hysteresis.visibility, 0.6f);
}

// The same rays see the same light: only the dither differs.
TEST(FieldControl, raysThatDoNotTurnAreTheSame) {
    Books books(smallDesc());
    const std::vector<glm::vec3> rays(books.directions.begin(), books.directions.end());
    const UpdateFrame before = books.comingUpdate();
    books.advance(false);
    EXPECT_TRUE(std::equal(rays.begin(), rays.end(), books.directions.begin()));
    EXPECT_EQ(books.comingUpdate().raySeed, before.raySeed);
    EXPECT_NE(books.comingUpdate().ditherSeed, before.ditherSeed);
    EXPECT_EQ(books.frame, 1);
}

TEST(FieldControl, volumesDifferByTheirWholeSeed) {
    FieldSetup one = smallDesc(), two = smallDesc();
    one.seed = 5;
    two.seed = 5 + (std::uint64_t(1) << 40);
    EXPECT_NE(Books(one).directions[0], Books(two).directions[0]);
    EXPECT_NE(Books(one).comingUpdate().ditherSeed, Books(two).comingUpdate().ditherSeed);
    EXPECT_EQ(Books(one).directions[3], Books(one).directions[3]);
}

TEST(FieldControl, eventsEnd) {
    Books books(smallDesc(FieldRules::paper));
    books.advance();
    books.events.notify(FieldEvent::smallLightChange);
    for (int i = 0; i < 4; ++i) {
        EXPECT_FLOAT_EQ(books.comingUpdate().hysteresis.irradiance, 0.9f * 0.85f);
        books.advance();
    }
    EXPECT_FLOAT_EQ(books.comingUpdate().hysteresis.irradiance, 0.9f);
    EXPECT_GE(books.bytes(), 32 * sizeof(glm::vec3));
}

TEST(FieldControl, settingsReachTheNextUpdateAndAreChecked) {
    FieldControl control = makeFieldControl(smallDesc(), smallDesc());
    FieldSettings settings = control.settings();
    EXPECT_EQ(settings.hysteresis, 0.9f);
    settings.guard = LeakGuard::none;
    settings.selfShadowBias = 0.7f;
    ASSERT_TRUE(control.setSettings(settings));
    EXPECT_EQ(control.settings(), settings);
    EXPECT_EQ(control.impl().comingUpdate().settings, settings);
    FieldSettings wrong = settings;
    wrong.hysteresis = 1;
    const auto refused = control.setSettings(wrong);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("hysteresis is 1"), std::string::npos) << refused.error().message;
    EXPECT_EQ(control.settings(), settings) << "a refused change changes nothing";
}

FieldSetup twoVolumes() {
    FieldSetup setup = smallDesc();
    setup.volumes = {{{1, 2, 3}, glm::vec3(0.5f), {3, 2, 2}}, {{-4, 0, 0}, {1, 2, 1}, {2, 4, 2}}};
    return setup;
}

TEST(FieldControl, allProbesOfAllVolumesAreTasksAtFirst) {
    const FieldSetup setup = twoVolumes();
    const FieldControl control = makeFieldControl(setup, setup);
    ASSERT_EQ(control.tasks().size(), 12u + 16u);
    for (std::uint32_t slot = 0; slot < 28; ++slot) {
        const ProbeTask& task = control.tasks()[slot];
        EXPECT_EQ(task.slot, slot);
        EXPECT_EQ(task.volume, slot < 12 ? 0u : 1u);
        EXPECT_EQ(task.origin, probePosition(setup.volumes[task.volume], int(slot < 12 ? slot : slot - 12)));
    }
    EXPECT_TRUE(control.impl().comingUpdate().whole());
}

TEST(FieldControl, tasksAreChosenBySlot) {
    const FieldSetup setup = twoVolumes();
    FieldControl control = makeFieldControl(setup, setup);
    const std::vector<ProbeTask> all(control.tasks().begin(), control.tasks().end());
    const std::vector<std::uint32_t> slots{20, 3, 12};
    ASSERT_TRUE(control.setTasks(slots));
    ASSERT_EQ(control.tasks().size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(control.tasks()[i].slot, slots[i]);
        EXPECT_EQ(control.tasks()[i].origin, all[slots[i]].origin);
        EXPECT_EQ(control.tasks()[i].volume, all[slots[i]].volume);
    }
    EXPECT_FALSE(control.impl().comingUpdate().whole());
    const std::vector<std::uint32_t> twice{4, 5, 4}, beyond{28};
    EXPECT_FALSE(control.setTasks(twice));
    EXPECT_FALSE(control.setTasks(beyond));
    EXPECT_EQ(control.tasks().size(), 3u) << "a refused list changes nothing";
    ASSERT_TRUE(control.setTasks({}));
    EXPECT_EQ(control.tasks().size(), 28u);
    EXPECT_TRUE(control.impl().comingUpdate().whole());
}

}  // namespace
}  // namespace probegi
