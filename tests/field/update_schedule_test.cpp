// Which probes an update with a budget has. Progress is made up here: what backends report is tested with them.
#include "field/update_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

#include "field/control_impl.h"
#include "kernels/probe/probe_state.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using kernels::ProbeProgress;
using test::FieldSetup;

constexpr int kEach = 20 + 12 + 4;  // rays of one probe
constexpr ProbeProgress kConverged{0.0f, 0.005f, 1.0f, 2.0f};

FieldSetup setupOf(glm::ivec3 counts, FieldRules rules = FieldRules::measured) {
    FieldSetup setup;
    setup.volumes[0].counts = counts;
    setup.raysPerProbe = 20;
    setup.fixedRays = 12;
    setup.emitterSamples = 4;
    setup.rules = rules;
    return setup;
}

UpdateBudget probes(int count) {
    UpdateBudget budget;
    budget.rays = std::int64_t(count) * kEach;
    return budget;
}

// A field's books, with progress that the test says.
struct Plan {
    explicit Plan(const FieldSetup& setup) : control(makeFieldControl(setup, setup)), progress(slots()) {}

    std::size_t slots() const { return std::size_t(probeCount(control.desc())); }
    std::set<int> tasks() const {
        std::set<int> all;
        for (const ProbeTask& task : control.tasks()) all.insert(int(task.slot));
        return all;
    }
    void update() { control.impl().advance(true, progress); }
    void settle(ProbeProgress all) {
        std::fill(progress.begin(), progress.end(), all);
        control.setBudget({}).value();
        for (int i = 0; i < 10; ++i) update();
    }

    FieldControl control;
    std::vector<ProbeProgress> progress;
};

TEST(UpdateSchedule, withoutABudgetAllProbesAreTasks) {
    Plan plan(setupOf({4, 4, 4}));
    EXPECT_FALSE(plan.control.budget().limits());
    plan.settle(kConverged);
    EXPECT_EQ(plan.tasks().size(), 64u);
    EXPECT_TRUE(plan.control.impl().comingUpdate().whole());
    EXPECT_FALSE(plan.control.impl().comingUpdate().reportsProgress);
    ASSERT_TRUE(plan.control.setBudget(probes(7)));
    EXPECT_EQ(plan.control.budget().rays, 7 * kEach);
    EXPECT_TRUE(plan.control.impl().comingUpdate().reportsProgress);
    EXPECT_FALSE(plan.control.impl().comingUpdate().whole());
    EXPECT_LE(plan.tasks().size(), 7u);
    ASSERT_TRUE(plan.control.setBudget({}));
    EXPECT_EQ(plan.tasks().size(), 64u);
    EXPECT_TRUE(plan.control.impl().comingUpdate().whole());
}

TEST(UpdateSchedule, wrongBudgetsAreRefusedInASentence) {
    Plan plan(setupOf({4, 4, 4}));
    ASSERT_TRUE(plan.control.setBudget(probes(5)));
    const auto refused = [&](const std::function<void(UpdateBudget&)>& spoil, const std::string& word) {
        UpdateBudget budget = probes(3);
        budget.view.emplace();
        ASSERT_TRUE(validateBudget(plan.control.desc(), budget));
        spoil(budget);
        const auto set = plan.control.setBudget(budget);
        ASSERT_FALSE(set) << word;
        EXPECT_EQ(set.error().code, ErrorCode::invalidArgument);
        EXPECT_NE(set.error().message.find(word), std::string::npos) << set.error().message;
        EXPECT_EQ(plan.control.budget().rays, 5 * kEach) << "a refused budget changes nothing";
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    refused([](UpdateBudget& b) { b.rays = kEach - 1; }, "at least 36");
    refused([](UpdateBudget& b) { b.rays = -1; }, "-1 rays");
    refused([](UpdateBudget& b) { b.milliseconds = -2; }, "-2 milliseconds");
    refused([&](UpdateBudget& b) { b.milliseconds = nan; }, "milliseconds");
    refused([&](UpdateBudget& b) { b.view->camera.position.x = nan; }, "camera");
    refused([](UpdateBudget& b) { b.view->camera.forward = {0, 0, -2}; }, "unit");
    refused([](UpdateBudget& b) { b.view->camera.up = {0, 0, 1}; }, "right angles");
    refused([](UpdateBudget& b) { b.view->camera.yfov = 0; }, "angle");
    refused([](UpdateBudget& b) { b.view->aspect = 0; }, "aspect");
    ASSERT_TRUE(plan.control.setBudget(probes(1)));
    EXPECT_EQ(plan.tasks().size(), 1u);
}

TEST(UpdateSchedule, thePapersProbesCostTheirRaysOnly) {
    Plan plan(setupOf({4, 4, 4}, FieldRules::paper));
    UpdateBudget budget;
    budget.rays = 3 * 20;
    ASSERT_TRUE(plan.control.setBudget(budget));
    EXPECT_EQ(plan.tasks().size(), 3u);
}

// Whatever probes say of themselves, what is announced, and how the budget changes from frame to frame: a quarter of
// the budget reaches all of them in turn.
TEST(UpdateSchedule, noProbeStarves) {
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        Plan plan(setupOf({4, 3, 5}));
        const int count = int(plan.slots());
        std::uniform_int_distribution<int> anySize(1, round % 2 ? 12 : 90), anySlot(0, count - 1), dice(0, 9);
        std::vector<int> reserveSince(plan.slots(), 0);  // of the frames in which the probe waited
        const int greedy = anySlot(random);
        for (int frame = 0; frame < 150; ++frame) {
            const int size = anySize(random);
            ASSERT_TRUE(plan.control.setBudget(probes(size)));
            // Others always see more change than one probe in three, or what they see is not a number.
            for (int slot = 0; slot < count; ++slot)
                plan.progress[std::size_t(slot)] = slot % 3 ? ProbeProgress{1e6f, 1.0f, 0.0f, 2.0f} : kConverged;
            plan.progress[std::size_t(greedy)] = {std::numeric_limits<float>::quiet_NaN(), 1.0f, 0.0f, 2.0f};
            if (dice(random) == 0)
                plan.control.notify(FieldEvent::largeLightChange, {glm::vec3(-1), glm::vec3(float(dice(random)))});
            if (dice(random) == 0) {
                const glm::ivec3 cells(dice(random) % 3 - 1, 0, dice(random) % 2);
                auto moved = plan.control.impl().scrolledBy(0, cells);
                ASSERT_TRUE(moved);
                plan.control.impl().swapPlacement(*moved);
                const auto& volume = plan.control.impl().volumes[0];
                for (int slot = 0; slot < count; ++slot)
                    if (kernels::hasEntered(volume, kernels::probeCell(volume, slot), cells))
                        reserveSince[std::size_t(slot)] = 0;
            }
            const std::set<int> tasks = plan.tasks();
            ASSERT_LE(int(tasks.size()), size) << "never more than the budget pays for";
            plan.update();
            for (int slot = 0; slot < count; ++slot) {
                int& since = reserveSince[std::size_t(slot)];
                since = tasks.count(slot) ? 0 : since + (size + 3) / 4;
                ASSERT_LT(since, count) << "slot " << slot << " frame " << frame;
            }
        }
    }
}

TEST(UpdateSchedule, allAreReachedInTheStatedNumberOfFrames) {
    Plan plan(setupOf({5, 5, 4}));
    plan.settle(kConverged);
    ASSERT_TRUE(plan.control.setBudget(probes(16)));
    std::set<int> reached;
    for (int frame = 0; frame < 25; ++frame) {
        EXPECT_EQ(plan.tasks().size(), 4u) << "paused probes have a quarter of the budget";
        reached.merge(plan.tasks());
        plan.update();
    }
    EXPECT_EQ(reached.size(), 100u);
}

TEST(UpdateSchedule, agesCountTheFieldsUpdates) {
    Plan plan(setupOf({4, 4, 4}));
    plan.settle(kConverged);
    EXPECT_EQ(plan.control.updateAge(3), 0);
    ASSERT_TRUE(plan.control.setBudget(probes(4)));
    const std::set<int> first = plan.tasks();
    for (int i = 0; i < 5; ++i) plan.update();
    for (int slot = 0; slot < 64; ++slot)
        EXPECT_TRUE(first.count(slot) ? plan.control.updateAge(slot) == 4 : plan.control.updateAge(slot) <= 5);
    EXPECT_EQ(std::count_if(plan.progress.begin(), plan.progress.end(),
                            [&, slot = 0](const auto&) mutable { return plan.control.updateAge(slot++) == 5; }),
              64 - 5);
}

// New probes, then announced changes, then seen ones by their size, then noise.
TEST(UpdateSchedule, prioritiesHaveTheirOrder) {
    Plan plan(setupOf({12, 2, 2}));
    plan.settle(kConverged);
    // By column along x, so far apart that no neighbour hears of it.
    plan.progress[0] = {0.0f, 0.05f, 0.3f, 2.0f};
    plan.progress[3] = {0.2f, 0.05f, 0.3f, 2.0f};
    plan.progress[6] = {0.9f, 0.05f, 0.3f, 2.0f};
    // They alone are updated once more: none of them has waited long.
    ASSERT_TRUE(plan.control.setTasks(std::vector<std::uint32_t>{0, 3, 6, 9}));
    plan.update();
    ASSERT_TRUE(plan.control.setTasks({}));
    plan.control.notify(FieldEvent::smallLightChange);  // without a budget: not by probe
    ASSERT_TRUE(plan.control.setBudget(probes(4 * 4)));
    const glm::vec3 at = probePosition(plan.control.desc().volumes[0], 9);
    plan.control.notify(FieldEvent::smallLightChange, {at, at});
    const auto wantedWith = [&](int count) {
        plan.control.setBudget(probes(count)).value();
        return plan.tasks();
    };
    const std::set<int> all = wantedWith(40);
    for (const int slot : {0, 3, 6, 9}) EXPECT_TRUE(all.count(slot)) << slot;
    int last = 100;
    for (const int slot : {9, 6, 3, 0}) {
        // The smallest budget with which the probe is among the tasks grows along the order.
        int fewest = 1;
        while (!wantedWith(fewest).count(slot)) ++fewest;
        if (slot == 9)
            EXPECT_LE(fewest, 2);
        else
            EXPECT_GE(fewest, last) << slot;
        last = fewest;
    }
    // A probe that enters comes before all of them.
    auto moved = plan.control.impl().scrolledBy(0, {1, 0, 0});
    ASSERT_TRUE(moved);
    plan.control.impl().swapPlacement(*moved);
    EXPECT_TRUE(wantedWith(6).count(0)) << "the four of a face took the slots of the first column";
}

TEST(UpdateSchedule, nearAndVisibleProbesComeFirst) {
    Plan plan(setupOf({16, 2, 2}));
    plan.settle({0.0f, 0.05f, 0.3f, 2.0f});
    FieldSettings settings = plan.control.settings();
    settings.camera = glm::vec3(15, 0, 0);
    ASSERT_TRUE(plan.control.setBudget(probes(8)));
    ASSERT_TRUE(plan.control.setSettings(settings));
    const auto near = [&](float from, float to) {
        int count = 0;
        for (const ProbeTask& task : plan.control.tasks()) count += task.origin.x >= from && task.origin.x <= to;
        return count;
    };
    EXPECT_GE(near(13, 15), 6) << "all but the reserve";
    UpdateBudget budget = probes(8);
    budget.view.emplace();
    budget.view->camera = {"", {8, 0, 0}, {-1, 0, 0}, {0, 1, 0}, 1.0f};
    ASSERT_TRUE(plan.control.setBudget(budget));
    EXPECT_GE(near(5, 9), 6) << "behind it, at the same distance, is nothing that it shows";
    EXPECT_LE(near(10, 15), 2);
}

TEST(UpdateSchedule, convergedProbesPauseAndWake) {
    Plan plan(setupOf({6, 6, 6}));
    plan.settle(kConverged);
    ASSERT_TRUE(plan.control.setBudget(probes(64)));
    EXPECT_EQ(plan.tasks().size(), 16u) << "the reserve";
    // One of them sees a change: it and its neighbours are updated.
    const int seer = *plan.tasks().begin();
    const std::set<int> looked = plan.tasks();
    plan.progress[std::size_t(seer)] = {0.5f, 0.005f, 1.0f, 2.0f};
    plan.update();
    const auto& volume = plan.control.impl().volumes[0];
    const glm::ivec3 at = kernels::probeCell(volume, seer);
    const std::set<int> woken = plan.tasks();
    EXPECT_TRUE(woken.count(seer));
    int beyond = 0;
    for (int slot = 0; slot < 216; ++slot) {
        const glm::ivec3 apart = glm::abs(kernels::probeCell(volume, slot) - at);
        const bool neighbour = std::max({apart.x, apart.y, apart.z}) == 1;
        EXPECT_TRUE(!neighbour || looked.count(slot) || woken.count(slot)) << slot;
        beyond += woken.count(slot) && !neighbour && slot != seer;
    }
    EXPECT_LE(beyond, 16) << "the others are the reserve";
    // They see nothing, and the seer follows: all pause again.
    plan.progress[std::size_t(seer)] = kConverged;
    plan.update();
    EXPECT_EQ(plan.tasks().size(), 16u);
}

TEST(UpdateSchedule, noiseKeepsProbesAwakeUntilTheirWindowIsLongest) {
    Plan plan(setupOf({4, 4, 4}));
    plan.settle({0.0f, 0.05f, 0.5f, 2.0f});
    ASSERT_TRUE(plan.control.setBudget(probes(32)));
    EXPECT_EQ(plan.tasks().size(), 32u);
    plan.settle({0.0f, 0.05f, 1.0f, 2.0f});
    ASSERT_TRUE(plan.control.setBudget(probes(32)));
    EXPECT_EQ(plan.tasks().size(), 8u) << "longer averages there are not";
    plan.settle({0.002f, 0.0f, 0.1f, 2.0f});
    ASSERT_TRUE(plan.control.setBudget(probes(32)));
    EXPECT_EQ(plan.tasks().size(), 8u) << "rounding of what is stored is no change";
}

// What counts is light: the same share of it is less in the dark, and small noise there is none.
TEST(UpdateSchedule, brightProbesComeBeforeDarkOnes) {
    Plan plan(setupOf({4, 4, 4}));
    plan.settle(kConverged);
    for (std::size_t slot = 0; slot < 64; ++slot) plan.progress[slot] = {0.0f, 0.05f, 0.3f, slot < 32 ? 0.2f : 20.0f};
    plan.update();
    ASSERT_TRUE(plan.control.setBudget(probes(16)));
    const std::set<int> tasks = plan.tasks();
    EXPECT_GE(std::distance(tasks.lower_bound(32), tasks.end()), 12) << "all but the reserve";
    ASSERT_TRUE(plan.control.setBudget(probes(64)));
    const std::set<int> more = plan.tasks();
    EXPECT_EQ(std::distance(more.lower_bound(32), more.end()), 32);
    EXPECT_LE(more.size(), 32u + 16u) << "dark ones pause but for their turn";
}

TEST(UpdateSchedule, ofWhatIsNotKnownNothingPauses) {
    Plan plan(setupOf({4, 4, 4}));
    ASSERT_TRUE(plan.control.setBudget(probes(16)));
    for (int i = 0; i < 40; ++i) {
        EXPECT_EQ(plan.tasks().size(), 16u);
        plan.control.impl().advance();  // a backend that reports nothing
    }
    for (int slot = 0; slot < 64; ++slot) EXPECT_LE(plan.control.updateAge(slot), 4) << "by age alone: in turn";
}

// Durations of events count each probe's own updates, however rare they are.
TEST(UpdateSchedule, eventsLastForEachProbesUpdates) {
    Plan plan(setupOf({4, 4, 4}));
    plan.settle(kConverged);
    ASSERT_TRUE(plan.control.setBudget(probes(6)));
    plan.control.notify(FieldEvent::smallLightChange);
    plan.control.notify(FieldEvent::smallObjectChange, {glm::vec3(0), glm::vec3(0.5f, 9, 9)});
    std::vector<int> light(64, 0), distances(64, 0);
    for (int frame = 0; frame < 200; ++frame) {
        const UpdateFrame coming = plan.control.impl().comingUpdate();
        EXPECT_TRUE(coming.events.empty());
        for (const ProbeTask& task : coming.tasks) {
            const kernels::EventLimit limit = coming.limitOf(task);
            EXPECT_NEAR(limit.irradianceKept, limit.irradianceKept < 1 ? 0.97f * 0.85f : 1.0f, 1e-6f);
            EXPECT_NEAR(limit.visibilityKept, limit.visibilityKept < 1 ? 0.97f * 0.5f : 1.0f, 1e-6f);
            light[task.slot] += limit.irradianceKept < 1;
            distances[task.slot] += limit.visibilityKept < 1;
        }
        plan.update();
    }
    EXPECT_FALSE(plan.control.impl().comingUpdate().hasEvents());
    for (int slot = 0; slot < 64; ++slot) {
        EXPECT_EQ(light[std::size_t(slot)], 4) << slot;
        EXPECT_EQ(distances[std::size_t(slot)], slot % 4 == 0 ? 7 : 0) << slot;
    }
}

TEST(UpdateSchedule, boxesThatAreInsideOutHoldNoneAndThoseOfNaNsAll) {
    Plan plan(setupOf({4, 4, 4}));
    plan.settle(kConverged);
    ASSERT_TRUE(plan.control.setBudget(probes(64)));
    plan.control.notify(FieldEvent::largeLightChange, {glm::vec3(3), glm::vec3(0)});
    EXPECT_FALSE(plan.control.impl().comingUpdate().hasEvents());
    plan.control.notify(FieldEvent::largeLightChange, {glm::vec3(std::nanf("")), glm::vec3(0)});
    EXPECT_EQ(plan.tasks().size(), 64u);
    EXPECT_TRUE(plan.control.impl().comingUpdate().hasEvents());
    EXPECT_FALSE(plan.control.impl().comingAverage({}).hasEvents());
}

TEST(UpdateSchedule, chosenTasksAreLimitedInTheirOrder) {
    Plan plan(setupOf({4, 4, 4}));
    const std::vector<std::uint32_t> slots{60, 3, 12, 40, 7};
    ASSERT_TRUE(plan.control.setTasks(slots));
    ASSERT_TRUE(plan.control.setBudget(probes(3)));
    std::set<int> reached;
    for (int frame = 0; frame < 3; ++frame) {
        ASSERT_EQ(plan.control.tasks().size(), 3u);
        std::size_t at = 0;
        for (const ProbeTask& task : plan.control.tasks()) {
            while (at < slots.size() && slots[at] != task.slot) ++at;
            EXPECT_LT(at, slots.size());
        }
        reached.merge(plan.tasks());
        plan.update();
    }
    EXPECT_EQ(reached.size(), 5u);
}

TEST(UpdateSchedule, millisecondsFollowWhatUpdatesTook) {
    Plan plan(setupOf({10, 10, 10}));
    UpdateBudget budget;
    budget.milliseconds = 10;
    ASSERT_TRUE(plan.control.setBudget(budget));
    EXPECT_EQ(plan.tasks().size(), 64u) << "before it knows";
    for (int frame = 0; frame < 30; ++frame) {
        plan.progress.assign(1000, {1.0f, 0.1f, 0.1f, 2.0f});
        plan.control.reportTime(1.0 + 0.05 * double(plan.tasks().size()), int(plan.tasks().size()));
        plan.update();
    }
    EXPECT_NEAR(double(plan.tasks().size()), 180, 10) << "1 + 0.05 x 180 = 10";
    budget.rays = 40 * kEach;
    ASSERT_TRUE(plan.control.setBudget(budget));
    EXPECT_EQ(plan.tasks().size(), 40u) << "the smaller budget counts";
}

}  // namespace
}  // namespace probegi
