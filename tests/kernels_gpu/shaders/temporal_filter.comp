#include "lane.h"

#include "kernels/blend/temporal_filter.h"

void giveFilter(INOUT(Lane) lane, ProbeFilter f, float tolerance) {
    for (int i = 0; i < kSightLobes; ++i) give(lane, f.direct[i], tolerance);
    for (int i = 0; i < kDistanceLobes; ++i) give(lane, f.distance[i], tolerance);
    give(lane, f.bounced, tolerance);
    give(lane, f.noise, tolerance);
    give(lane, f.window, tolerance);
    give(lane, f.visibilityWindow, tolerance);
    giveBits(lane, isUnknown(f) ? 1u : 0u);
}

ProbeFilter takeFilter(INOUT(Lane) lane) {
    ProbeFilter f;
    for (int i = 0; i < kSightLobes; ++i) f.direct[i] = takeBetween(lane, 0.0f, 20.0f);
    for (int i = 0; i < kDistanceLobes; ++i) f.distance[i] = takeUnit(lane);
    f.bounced = takeBetween(lane, -1.0f, 5.0f);
    f.noise = takeUnit(lane);
    f.window = takeBetween(lane, 0.0f, kLongestWindow);
    f.visibilityWindow = takeBetween(lane, 0.0f, 33.0f);
    return f;
}

ProbeSight takeSight(INOUT(Lane) lane) {
    SightSum sum = noSight();
    for (int i = 0; i < 2; ++i) {
        const vec3 direction = takeDirection(lane);
        const float direct = takeBetween(lane, -1.0f, 20.0f);
        const float bounced = takeBetween(lane, 0.0f, 5.0f);
        const float distance = takeBetween(lane, -3.0f, 3.0f);
        addToSight(sum, direction, direct, bounced, distance, 2.0f);
    }
    const vec3 radiance = takeVector(lane, -0.1f, 2.0f);
    const float distance = takeBetween(lane, -1.0f, 3.0f);
    addOwnRayToSight(sum, radiance, distance);
    return sightOf(sum);
}

void giveLag(INOUT(Lane) lane, ProbeLag lag) {
    give(lane, lag.direct, 2e-5f);
    give(lane, lag.bounced, 2e-5f);
    give(lane, lag.level, 2e-5f);
    give(lane, lag.distance, 2e-5f);
}

void evaluate(INOUT(Lane) lane) {
    const vec3 direction = takeDirection(lane);
    giveBits(lane, uint(sightLobe(direction)));
    giveBits(lane, uint(distanceLobe(sightLobe(direction))));

    const ProbeSight sight = takeSight(lane);
    ProbeFilter state = takeFilter(lane);
    const ProbeLag lag = lagHeard(probeLag(sight, state), 0.1f);
    giveLag(lane, lag);
    LagAround around = noLag();
    addLag(around, lag, 2.0f * lag.level, true);
    addLag(around, probeLag(takeSight(lane), state), 100.0f, false);
    const float noise = takeUnit(lane);
    give(lane, filterLag(around, noise, state.window, false), 1e-3f);
    give(lane, filterLag(around, 0.1f * noise, state.window, true), 1e-3f);
    give(lane, ownLag(around, noise, state.window, false), 1e-3f);
    give(lane, lagOf(noise, 0.5f * noise, 0.1f, state.window, false), 1e-3f);
    give(lane, noProgress().lag, 0.0f);
    const ProbeProgress progress = probeProgress(noise, state, 0.5f * noise);
    give(lane, progress.lag, 1e-6f);
    give(lane, progress.noise, 1e-5f);
    give(lane, progress.confidence, 1e-6f);
    give(lane, progress.level, 2e-5f);
    const float share = takeUnit(lane);
    give(lane, lagBeyondNoise(share, 0.0f), 1e-5f);
    give(lane, bearableWindow(state.window, noise, 0.1f + share, kLongestWindow), 1e-5f);
    give(lane, nextWindow(state.window, noise, 0.1f + share, kLongestWindow), 1e-5f);
    give(lane, nextVisibilityWindow(state.visibilityWindow, 0.1f + share, 33.0f), 1e-5f);
    give(lane, keptBy(state.window), 1e-5f);
    give(lane, nextNoise(noise, 9.0f * share, share, state.window, isUnknown(state)), 1e-4f);

    TexelChange change = noChange();
    const vec3 stored = takeVector(lane, 0.0f, 2.0f);
    const vec3 mean = takeVector(lane, 0.0f, 20.0f);
    addTexelChange(change, stored, mean);
    TexelChange sum = noChange();
    joinChanges(sum, change);
    give(lane, relativeChange(sum, 3), 1e-4f);

    advanceFilter(state, sight);
    giveFilter(lane, state, 2e-5f);
    const PackedProbeFilter packed = packFilter(state, takeBits(lane));
    // Halves may be rounded to either side if the last bit of the light differs.
    giveFilter(lane, unpackFilter(packed), 8e-3f);
    giveFilter(lane, unpackFilter(forgottenFilter(state.window)), 1e-3f);
    giveFilter(lane, unpackFilter(newFilter()), 1e-6f);
    giveBits(lane, (isNew(packed) ? 1u : 0u) + (isNew(newFilter()) ? 2u : 0u));
    give(lane, unpackLight(packLight(takeBetween(lane, 0.0f, 1000.0f), 0u)), 8e-3f);
    giveBits(lane, packWindows(float(takeIndex(lane, 200)), 3.5f));
}
