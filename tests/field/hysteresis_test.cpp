#include "field/hysteresis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace probegi {
namespace {

const FieldSettings kSettings{.hysteresis = 0.9f, .visibilityHysteresis = 0.8f};

// The factors on both hysteresis values in the frames after an event.
std::vector<std::pair<float, float>> framesAfter(FieldEvent event, int frames) {
    HysteresisSchedule schedule;
    schedule.notify(event);
    std::vector<std::pair<float, float>> result;
    for (int i = 0; i < frames; ++i) {
        const FrameHysteresis h = schedule.current(kSettings, false);
        result.emplace_back(h.irradiance / 0.9f, h.visibility / 0.8f);
        schedule.advance();
    }
    return result;
}

TEST(Hysteresis, firstFrameKeepsNothing) {
    const FrameHysteresis h = HysteresisSchedule().current(kSettings, true);
    EXPECT_EQ(h.irradiance, 0.0f);
    EXPECT_EQ(h.visibility, 0.0f);
}

TEST(Hysteresis, eventsFollowSection43) {
    struct Case {
        FieldEvent event;
        float irradianceFactor;
        int irradianceFrames, visibilityFrames;
    };
    for (const Case& c :
         {Case{FieldEvent::smallLightChange, 0.85f, 4, 0}, Case{FieldEvent::largeLightChange, 0.5f, 10, 0},
          Case{FieldEvent::largeObjectChange, 0.5f, 10, 7}, Case{FieldEvent::smallObjectChange, 0.85f, 4, 7}}) {
        const auto frames = framesAfter(c.event, 12);
        for (int i = 0; i < 12; ++i) {
            EXPECT_FLOAT_EQ(frames[i].first, i < c.irradianceFrames ? c.irradianceFactor : 1.0f) << i;
            EXPECT_FLOAT_EQ(frames[i].second, i < c.visibilityFrames ? 0.5f : 1.0f) << i;
        }
    }
}

TEST(Hysteresis, ofTwoEventsTheStrongerCounts) {
    HysteresisSchedule schedule;
    schedule.notify(FieldEvent::largeLightChange);
    schedule.notify(FieldEvent::smallLightChange);
    EXPECT_FLOAT_EQ(schedule.current(kSettings, false).irradiance, 0.45f);
}

Bounds cube(float lower, float upper) {
    return {glm::vec3(lower), glm::vec3(upper)};
}

// The reductions of section 4.3, for probes in the box only.
TEST(Hysteresis, boxesFollowSection43) {
    struct Case {
        FieldEvent event;
        float irradianceFactor;
        int irradianceFrames, visibilityFrames;
    };
    for (const Case& c :
         {Case{FieldEvent::smallLightChange, 0.85f, 4, 0}, Case{FieldEvent::largeLightChange, 0.5f, 10, 0},
          Case{FieldEvent::largeObjectChange, 0.5f, 10, 7}, Case{FieldEvent::smallObjectChange, 0.85f, 4, 7}}) {
        HysteresisSchedule schedule;
        schedule.notify(c.event, cube(0, 1));
        for (int i = 0; i < 12; ++i) {
            const EventRegions regions = schedule.regions(kSettings, false);
            ASSERT_EQ(regions.count, i < std::max(c.irradianceFrames, c.visibilityFrames) ? 1 : 0) << i;
            const kernels::EventLimit inside = regions.limitAt(glm::vec3(0.5f)),
                                      outside = regions.limitAt(glm::vec3(2));
            EXPECT_FLOAT_EQ(inside.irradianceKept, i < c.irradianceFrames ? 0.9f * c.irradianceFactor : 1.0f) << i;
            EXPECT_FLOAT_EQ(inside.visibilityKept, i < c.visibilityFrames ? 0.4f : 1.0f) << i;
            EXPECT_EQ(outside.irradianceKept, 1.0f);
            EXPECT_EQ(outside.visibilityKept, 1.0f);
            EXPECT_EQ(schedule.current(kSettings, false).irradiance, 0.9f) << "elsewhere as ever";
            EXPECT_FALSE(schedule.irradianceEvent() || schedule.visibilityEvent());
            schedule.advance();
        }
    }
}

TEST(Hysteresis, theFirstFrameHasNoBoxes) {
    HysteresisSchedule schedule;
    schedule.notify(FieldEvent::largeLightChange, cube(0, 1));
    EXPECT_TRUE(schedule.regions(kSettings, true).empty());
    EXPECT_FALSE(schedule.regions(kSettings, false).empty());
}

TEST(Hysteresis, theSameBoxTwiceIsOneThatLastsLonger) {
    HysteresisSchedule schedule;
    schedule.notify(FieldEvent::largeObjectChange, cube(0, 1));
    for (int i = 0; i < 5; ++i) schedule.advance();
    schedule.notify(FieldEvent::largeLightChange, cube(0, 1));
    EXPECT_EQ(schedule.regions(kSettings, false).count, 1);
    for (int i = 0; i < 2; ++i) schedule.advance();
    EXPECT_EQ(schedule.regions(kSettings, false).boxes[0].visibilityKept, 1.0f) << "the first event's seven are over";
    for (int i = 0; i < 7; ++i) schedule.advance();
    EXPECT_EQ(schedule.regions(kSettings, false).count, 1);
    schedule.advance();
    EXPECT_TRUE(schedule.regions(kSettings, false).empty());
}

// Nine boxes: the ninth joins the one beside it, so that no probe of any box is left out.
TEST(Hysteresis, tooManyBoxesAreJoinedWithTheNearest) {
    HysteresisSchedule schedule;
    for (int i = 0; i < kernels::kMostEventRegions; ++i)
        schedule.notify(FieldEvent::smallLightChange, cube(float(10 * i), float(10 * i + 1)));
    schedule.notify(FieldEvent::largeLightChange, cube(32, 33));
    const EventRegions regions = schedule.regions(kSettings, false);
    EXPECT_EQ(regions.count, kernels::kMostEventRegions);
    EXPECT_FLOAT_EQ(regions.limitAt(glm::vec3(32.5f)).irradianceKept, 0.45f);
    EXPECT_FLOAT_EQ(regions.limitAt(glm::vec3(30.5f)).irradianceKept, 0.45f) << "the stronger one counts";
    EXPECT_FLOAT_EQ(regions.limitAt(glm::vec3(40.5f)).irradianceKept, 0.9f * 0.85f);
    EXPECT_EQ(regions.limitAt(glm::vec3(36)).irradianceKept, 1.0f);
}

TEST(Hysteresis, boxesThatAreNone) {
    HysteresisSchedule schedule;
    schedule.notify(FieldEvent::largeLightChange, {glm::vec3(1), glm::vec3(0)});
    EXPECT_TRUE(schedule.regions(kSettings, false).empty()) << "inside out: no probe";
    EXPECT_FALSE(schedule.irradianceEvent());
    schedule.notify(FieldEvent::largeLightChange, {glm::vec3(0), glm::vec3(0)});
    EXPECT_EQ(schedule.regions(kSettings, false).count, 1) << "a point may hold a probe";
    schedule.notify(FieldEvent::largeLightChange, {glm::vec3(0), {1, NAN, 1}});
    EXPECT_TRUE(schedule.irradianceEvent()) << "rather all probes than none";
    const Bounds all{glm::vec3(-INFINITY), glm::vec3(INFINITY)};
    for (int i = 0; i < 20; ++i) schedule.notify(FieldEvent::smallLightChange, {glm::vec3(float(i)), glm::vec3(50)});
    schedule.notify(FieldEvent::largeLightChange, all);
    EXPECT_FLOAT_EQ(schedule.regions(kSettings, false).limitAt(glm::vec3(1e6f)).irradianceKept, 0.45f);
}

}  // namespace
}  // namespace probegi
