#include "field/hysteresis.h"

#include <gtest/gtest.h>

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
          Case{FieldEvent::largeObjectChange, 0.5f, 10, 7}}) {
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

}  // namespace
}  // namespace probegi
