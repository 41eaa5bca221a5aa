#include "kernels/blend/temporal_filter.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

ProbeSight evenSight(float direct, float bounced, float distance) {
    SightSum sum = noSight();
    for (int i = 0; i < 8; ++i) {
        const vec3 d(i & 1 ? -1.0f : 1.0f, i & 2 ? -1.0f : 1.0f, i & 4 ? -1.0f : 1.0f);
        addToSight(sum, d / std::sqrt(3.0f), direct, bounced, distance, 1.0f);
    }
    return sightOf(sum);
}

ProbeFilter settled(float direct, float bounced, float window) {
    ProbeFilter f = unpackFilter(PackedProbeFilter{});
    f.window = f.visibilityWindow = window;
    advanceFilter(f, evenSight(direct, bounced, 0.5f));
    return f;
}

LagAround alone(const ProbeLag& lag) {
    LagAround around = noLag();
    addLag(around, lag, lag.level, true);
    return around;
}

TEST(TemporalFilter, aNewProbeKnowsNothing) {
    const ProbeFilter f = unpackFilter(PackedProbeFilter{});
    EXPECT_TRUE(isUnknown(f));
    EXPECT_EQ(f.window, 0.0f);
    const ProbeLag lag = probeLag(evenSight(3, 1, 0.5f), f);
    EXPECT_EQ(lag.direct, 0.0f);
    EXPECT_EQ(lag.bounced, 0.0f);
    EXPECT_FLOAT_EQ(lag.level, 4.0f);
}

TEST(TemporalFilter, theFirstSightIsTheAverage) {
    const ProbeFilter f = settled(3, 1, 50);
    EXPECT_FALSE(isUnknown(f));
    for (const float direct : f.direct) EXPECT_FLOAT_EQ(direct, 3.0f);
    EXPECT_FLOAT_EQ(f.bounced, 1.0f);
}

// Closed form of a running average of a step: after k updates with window w, (1 - 1/w)^k of it remains.
TEST(TemporalFilter, averagesLagLikeTheProbe) {
    ProbeFilter f = settled(1, 0, 20);
    for (int k = 0; k < 30; ++k) advanceFilter(f, evenSight(2, 0, 0.5f));
    const float left = std::pow(1.0f - 1.0f / 20.0f, 30.0f);
    EXPECT_NEAR(f.direct[5], 2.0f - left, 1e-4f);
    EXPECT_NEAR(filterLag(alone(probeLag(evenSight(2, 0, 0.5f), f)), 0.5f, f.window, false), left / 2.0f, 1e-4f);
}

TEST(TemporalFilter, stillLightHasNoLag) {
    EXPECT_EQ(filterLag(alone(probeLag(evenSight(3, 1, 0.5f), settled(3, 1, 50))), 0.1f, 50.0f, false), 0.0f);
}

TEST(TemporalFilter, changeIsARatioAtEveryBrightness) {
    for (const float level : {1e-6f, 1.0f, 1e6f}) {
        const auto lagAfter = [&](float factor) {
            const ProbeLag lag = probeLag(evenSight(factor * level, 0, 0.5f), settled(level, 0, 50));
            return filterLag(alone(lag), 0.1f, 50.0f, false);
        };
        EXPECT_NEAR(lagAfter(0.1f), 0.9f, 1e-3f);
        EXPECT_NEAR(lagAfter(10.0f), 0.9f, 1e-3f);
        EXPECT_NEAR(lagAfter(0.8f), 0.2f, 1e-3f);
    }
}

// A dark probe beside a bright one ignores flicker that is negligible beside its neighbour's light.
TEST(TemporalFilter, darkProbesAreJudgedByTheirBrightestNeighbour) {
    const ProbeLag dark = probeLag(evenSight(0.002f, 0, 0.5f), settled(0.001f, 0, 50));
    LagAround around = noLag();
    addLag(around, dark, 10.0f, true);
    EXPECT_NEAR(around.direct, 0.001f / (kDarkShare * 10.0f), 1e-5f);
}

TEST(TemporalFilter, bouncedNoiseOfNeighboursCancels) {
    LagAround around = noLag();
    for (int i = 0; i < 26; ++i) {
        ProbeLag lag{};
        lag.bounced = i % 2 ? 0.5f : -0.5f;
        lag.level = 1.0f;
        addLag(around, lag, 1.0f, i == 0);
    }
    EXPECT_NEAR(filterLag(around, 0.0f, 50.0f, false), 0.0f, 1e-6f);
}

// Bounced light that lags by 1 % of the light will lag by 3 % after all later bounces.
TEST(TemporalFilter, bouncedLagCountsWithItsLaterBounces) {
    const ProbeLag lag = probeLag(evenSight(3, 0.9f, 0.5f), settled(3, 1, 50));
    EXPECT_NEAR(filterLag(alone(lag), 0.0f, 50.0f, false), kBounceLag * 0.1f / 4.0f, 1e-4f);
}

// What a schedule goes by is the probe's own lag: what its neighbours see shortens its window, but is not news from it.
TEST(TemporalFilter, ownLagIsThatOfTheProbeAlone) {
    const ProbeLag mine = probeLag(evenSight(1.1f, 0, 0.5f), settled(1, 0, 50)),
                   theirs = probeLag(evenSight(1.9f, 0, 0.5f), settled(1, 0, 50));
    LagAround around = noLag();
    addLag(around, mine, theirs.level, true);
    addLag(around, theirs, theirs.level, false);
    EXPECT_NEAR(ownLag(around, 0.1f, 50.0f, false), 0.1f / 1.1f, 1e-4f);
    EXPECT_NEAR(filterLag(around, 0.1f, 50.0f, false), kSpreadLag * 0.9f / 1.9f, 1e-4f);
    EXPECT_EQ(ownLag(around, 0.1f, 50.0f, true), 0.0f) << "below the noise of its own rays";
    const ProbeLag bounces = probeLag(evenSight(3, 0.9f, 0.5f), settled(3, 1, 50));
    EXPECT_NEAR(ownLag(alone(bounces), 0.0f, 50.0f, false), kBounceLag * 0.1f / 4.0f, 1e-4f);
}

TEST(TemporalFilter, progressIsWhatIsLeftOfNoiseInTheAverage) {
    ProbeFilter f = settled(1, 0, 50);
    f.noise = 0.3f;
    const ProbeProgress open = probeProgress(0.2f, f, 0.0f);
    EXPECT_EQ(open.lag, 0.2f);
    EXPECT_NEAR(open.noise, 0.3f / std::sqrt(99.0f), 1e-6f);
    EXPECT_FLOAT_EQ(open.confidence, 0.25f);
    EXPECT_FLOAT_EQ(open.level, 1.0f);
    EXPECT_NEAR(probeProgress(0, settled(3, 1, 50), 0).level, 4.0f, 1e-5f);
    const ProbeProgress inside = probeProgress(0.2f, f, 0.9f);
    EXPECT_EQ(inside.lag, 0.0f) << "in a wall it does not matter";
    EXPECT_EQ(inside.noise, 0.0f);
    EXPECT_EQ(inside.level, 0.0f);
    EXPECT_EQ(noProgress().confidence, 0.0f);
    f.window = 0;
    EXPECT_TRUE(std::isfinite(probeProgress(0, f, 0).noise));
}

// An average over a window of w updates keeps noise / sqrt(2 w - 1): so much of a change of bounced light is ignored.
TEST(TemporalFilter, noiseOfBouncedLightIsNotLag) {
    LagAround around = noLag();
    around.level = 1.0f;
    const float left = 0.2f / std::sqrt(2.0f * 50.0f - 1.0f);
    for (const float sign : {-1.0f, 1.0f}) {
        around.bounced = sign * 0.99f * left;
        EXPECT_EQ(filterLag(around, 0.2f, 50.0f, false), 0.0f);
        around.bounced = sign * 2.0f * left;
        EXPECT_NEAR(filterLag(around, 0.2f, 50.0f, false), kBounceLag * std::sqrt(3.0f) * left, 1e-5f);
    }
    around.bounced = 0.0f;
    around.direct = 0.3f;  // direct light has no noise
    EXPECT_FLOAT_EQ(filterLag(around, 0.2f, 50.0f, false), 0.3f);
}

// Windows at first grow by a share of their length, while bounces arrive, and later by half an update.
TEST(TemporalFilter, youngWindowsGrowSlowly) {
    EXPECT_FLOAT_EQ(nextWindow(2, 0.4f, 0.0f, 200), 2.0f + 2.0f * kYoungGrowth);
    EXPECT_FLOAT_EQ(nextWindow(10, 0.4f, 0.0f, 200), 10.5f);
    EXPECT_FLOAT_EQ(nextVisibilityWindow(2, 0.0f, 200), 2.5f);
}

// The lag equals the noise that remains in an average over that window: lag^2 = noise^2 / (2 window).
TEST(TemporalFilter, windowsBalanceLagAndNoise) {
    EXPECT_FLOAT_EQ(nextWindow(100, 0.4f, 0.1f, 200), 8.0f);
    EXPECT_FLOAT_EQ(nextWindow(100, 0.4f, 0.9f, 200), 1.0f);
    EXPECT_FLOAT_EQ(nextWindow(100, 0.4f, 0.0f, 200), 100.5f);
    EXPECT_FLOAT_EQ(nextWindow(200, 0.4f, 0.0f, 200), 200.0f);
    EXPECT_FLOAT_EQ(nextWindow(100, 0.4f, 0.0f, 33), 33.0f);
    EXPECT_FLOAT_EQ(nextWindow(0, 0.0f, 0.0f, 200), 1.0f);
    EXPECT_FLOAT_EQ(keptBy(4.0f), 0.75f);
    EXPECT_FLOAT_EQ(keptBy(0.0f), 0.0f);
}

// From the difference between two independent values of one variance, one of them averaged over a window.
TEST(TemporalFilter, noiseIsThatOfOneUpdate) {
    float noise = 0.3f;
    const float window = 5.0f, variance = 0.04f;
    const float change = variance * (1.0f + 1.0f / (2.0f * window - 1.0f));
    for (int k = 0; k < 300; ++k) noise = nextNoise(noise, change, 0.0f, window, false);
    EXPECT_NEAR(noise, 0.2f, 1e-3f);
    EXPECT_EQ(nextNoise(0.3f, 1.0f, 0.0f, 1.0f, true), 0.0f);
}

TEST(TemporalFilter, lagIsNotTakenForNoise) {
    EXPECT_LE(nextNoise(0.1f, 0.81f, 0.9f, 1.0f, false), 0.1f);
    EXPECT_LE(nextNoise(0.1f, 1.5f, 0.9f, 1.0f, false), 0.1f);
    EXPECT_GT(nextNoise(0.1f, 1.5f, 0.1f, 1.0f, false), 0.2f);
}

TEST(TemporalFilter, ownRaysCountBeyondTheirNoise) {
    EXPECT_EQ(lagBeyondNoise(0.25f, 0.1f), 0.0f);
    EXPECT_NEAR(lagBeyondNoise(0.5f, 0.1f), 0.4f, 1e-6f);
    EXPECT_EQ(lagBeyondNoise(0.5f, 0.0f), 0.5f);
}

// By dithered rounding to halves, the mean of many packed values is the value, at every level.
TEST(TemporalFilter, packingKeepsTheMean) {
    for (const float level : {1e-6f, 1e-2f, 1.0f, 1e4f}) {
        ProbeFilter f = settled(level, 0.3f * level, 7.5f);
        f.noise = 0.123f;
        double sum = 0, noise = 0;
        const int count = 4096;
        for (int i = 0; i < count; ++i) {
            const ProbeFilter back = unpackFilter(packFilter(f, hashUint(std::uint32_t(i))));
            sum += back.direct[2];
            noise += back.noise;
            ASSERT_EQ(back.window, 7.5f);
            ASSERT_FALSE(isUnknown(back));
        }
        EXPECT_NEAR(sum / count / level, 1.0, 1e-3);
        EXPECT_NEAR(noise / count, 0.123, 1e-4);
    }
    const ProbeFilter forgotten = unpackFilter(forgottenFilter(1000));
    EXPECT_TRUE(isUnknown(forgotten));
    EXPECT_EQ(forgotten.window, kLongestWindow);
}

TEST(TemporalFilter, aNewProbesFilterSaysSo) {
    EXPECT_TRUE(isNew(newFilter()));
    EXPECT_TRUE(isUnknown(unpackFilter(newFilter())));
    EXPECT_EQ(nextWindow(unpackFilter(newFilter()).window, 0, 0, kLongestWindow), 1.0f) << "keeps nothing";
    EXPECT_FALSE(isNew(forgottenFilter(1)));
    ProbeFilter used = unpackFilter(newFilter());
    used.window = used.visibilityWindow = 1;
    EXPECT_FALSE(isNew(packFilter(used, 0)));
}

TEST(TemporalFilter, changeOfTexelsIsRelative) {
    TexelChange change = noChange();
    for (int i = 0; i < 4; ++i) addTexelChange(change, vec3(1.0f), vec3(i % 2 ? 1.5f : 0.5f));
    EXPECT_NEAR(relativeChange(change, 4), 0.25f, 1e-5f);
}

}  // namespace
}  // namespace probegi::kernels
