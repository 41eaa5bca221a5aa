// The temporal filter of a probe (in place of the DDGI paper's fixed hysteresis and the thresholds of its Listing 3).
//
// A probe's irradiance is a running average in linear light. Its window, in updates, trades noise (too short) against
// lag (too long). Noise is measured in the blend: how far an update's texels are from the average. Lag is measured by a
// few fixed rays that the probe traces in every update along the same directions: in a static scene they return the
// same direct light to the last bit, so their current light minus its own average, kept at the probe's rate, is exactly
// the lag of the probe's average. Light from the field (bounced) contains the field's noise, so it is averaged over
// neighbours first.
#ifndef PROBEGI_KERNELS_TEMPORAL_FILTER_H
#define PROBEGI_KERNELS_TEMPORAL_FILTER_H

#include "kernels/blend/probe_blend.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/probe/storage.h"
#include "kernels/screen/colour.h"

KERNELS_BEGIN

// Fixed rays are averaged by octant of their direction, distances by pairs of octants.
KERNEL_CONST int kSightLobes = 8;
KERNEL_CONST int kDistanceLobes = 4;

// Longest windows, in updates. Shorter for distances, since moving objects may pass between the fixed rays.
KERNEL_CONST float kLongestWindow = 200.0f;
KERNEL_CONST float kLongestVisibilityWindow = 100.0f;
// Growth of a window per update, in updates: with a half, the weight of what precedes the last k updates falls like 1 /
// k^2.
KERNEL_CONST float kWindowGrowth = 0.5f;
// Upper limit of the same as a share of the window: after a change of light, windows stay short until the bounces have
// arrived, about five updates. In rooms lit by a small patch of sun this lag goes undetected: it is smaller than the
// noise of the patch, which all probes of the room share.
KERNEL_CONST float kYoungGrowth = 0.15f;
// Floor of a probe's brightness relative to its brightest neighbour, since in the dark a negligible flicker is a large
// ratio.
KERNEL_CONST float kDarkShare = 0.05f;
// Share of a neighbour's lag that a probe adopts.
KERNEL_CONST float kSpreadLag = 0.5f;
// Factor on the lag of bounced light, which recurs with every further bounce: three times as much in total if surfaces
// reflect two thirds. With 1, a room with many bounces keeps a tenth of a small change for twice as long
// (docs/accuracy.md), with the same flicker.
KERNEL_CONST float kBounceLag = 3.0f;
// An update's change below this multiple of the lag's square says nothing about noise.
KERNEL_CONST float kLagInChange = 4.0f;
// Updates over which noise is averaged.
KERNEL_CONST float kNoiseWindow = 16.0f;

// Results of a probe's fixed rays in one update.
struct ProbeSight {
    float direct[8];    // mean of a lobe's rays, W sr^-1 m^-2
    float bounced;      // mean of all
    float distance[4];  // mean of a lobe's rays, as a fraction of the farthest
};

// The averages and windows of a probe: 32 bytes when packed.
struct ProbeFilter {
    float direct[8];  // of ProbeSight, at the rate 1 / window
    float bounced;    // the same; below 0: the averages are unknown
    float distance[4];
    float noise;             // standard deviation of one update's texels, as a share of their mean
    float window;            // updates; 0: the probe is new
    float visibilityWindow;  // the same for distances
};

struct PackedProbeFilter {
    uint words[8];
};

// How far a probe's averages lag behind.
struct ProbeLag {
    float direct;    // root mean square over lobes, W sr^-1 m^-2
    float bounced;   // now minus average, W sr^-1 m^-2
    float level;     // the larger of now and average, W sr^-1 m^-2
    float distance;  // largest over lobes, relative
};

KERNEL_FN bool isUnknown(ProbeFilter f) {
    return f.bounced < 0.0f;
}

KERNEL_FN int sightLobe(vec3 direction) {
    return (direction.x < 0.0f ? 1 : 0) | (direction.y < 0.0f ? 2 : 0) | (direction.z < 0.0f ? 4 : 0);
}
KERNEL_FN int distanceLobe(int lobe) {
    return lobe >> 1;
}

// Accumulator for ProbeSight.
struct SightSum {
    float direct[8];
    float distance[4];
    float rays[8];  // of each lobe
    float bounced;
};

KERNEL_FN SightSum noSight() {
    SightSum sum;
    for (int i = 0; i < kSightLobes; ++i) {
        sum.direct[i] = 0.0f;
        sum.rays[i] = 0.0f;
    }
    for (int i = 0; i < kDistanceLobes; ++i) sum.distance[i] = 0.0f;
    sum.bounced = 0.0f;
    return sum;
}

// Adds a fixed ray; lights are luminances, `distance` as in RayDatum, all unsanitised.
KERNEL_FN void addToSight(INOUT(SightSum) sum, vec3 direction, float direct, float bounced, float distance,
                          float maxDistance) {
    const int lobe = sightLobe(direction);
    sum.direct[lobe] += safeRadiance(direct);
    sum.bounced += safeRadiance(bounced);
    sum.distance[distanceLobe(lobe)] += visibilityDistance(safeDistance(distance), maxDistance);
    sum.rays[lobe] += 1.0f;
}

// The same for an update ray: its direction changes with every update, so only the mean over all rays is meaningful.
KERNEL_FN void addOwnRayToSight(INOUT(SightSum) sum, vec3 radiance, float distance) {
    const float light = luminance(arrivingRadiance(safeDistance(distance), radiance));
    for (int i = 0; i < kSightLobes; ++i) {
        sum.direct[i] += light;
        sum.rays[i] += 1.0f;
    }
}

KERNEL_FN ProbeSight sightOf(SightSum sum) {
    ProbeSight sight;
    float rays = 0.0f;
    for (int i = 0; i < kSightLobes; ++i) {
        sight.direct[i] = sum.direct[i] / max(sum.rays[i], 1.0f);
        rays += sum.rays[i];
    }
    for (int i = 0; i < kDistanceLobes; ++i)
        sight.distance[i] = sum.distance[i] / max(sum.rays[2 * i] + sum.rays[2 * i + 1], 1.0f);
    sight.bounced = sum.bounced / max(rays, 1.0f);
    return sight;
}

KERNEL_FN ProbeLag probeLag(ProbeSight now, ProbeFilter state) {
    float sum = 0.0f, sumBefore = 0.0f, square = 0.0f, farthest = 0.0f;
    for (int i = 0; i < kSightLobes; ++i) {
        const float change = now.direct[i] - state.direct[i];
        sum += now.direct[i];
        sumBefore += state.direct[i];
        square += change * change;
    }
    for (int i = 0; i < kDistanceLobes; ++i)
        farthest = max(farthest,
                       abs(now.distance[i] - state.distance[i]) / max(max(now.distance[i], state.distance[i]), 1e-3f));
    const bool known = !isUnknown(state);
    const float lobe = 1.0f / float(kSightLobes);
    ProbeLag lag;
    lag.direct = known ? sqrt(square * lobe) : 0.0f;
    lag.bounced = known ? now.bounced - state.bounced : 0.0f;
    lag.level = max(sum * lobe + now.bounced, known ? sumBefore * lobe + state.bounced : 0.0f);
    lag.distance = known ? farthest : 0.0f;
    return lag;
}

// Probes in solid matter are ignored by their neighbours: they are unused, and what they see depends on materials.
KERNEL_FN ProbeLag lagHeard(ProbeLag lag, float backfaceShare) {
    const float heard = backfaceShare < kInsideShare + kInsideShareEdge ? 1.0f : 0.0f;
    lag.direct *= heard;
    lag.bounced *= heard;
    lag.level *= heard;
    lag.distance *= heard;
    return lag;
}

// The lag of a probe and its neighbours, as a share of the light.
struct LagAround {
    float direct;
    float bounced;  // sum of ProbeLag::bounced
    float level;    // sum of ProbeLag::level
    float distance;
    float ownDirect;   // of the probe itself
    float ownBounced;  // the same, of its own light
};

KERNEL_FN LagAround noLag() {
    LagAround around;
    around.direct = 0.0f;
    around.bounced = 0.0f;
    around.level = 0.0f;
    around.distance = 0.0f;
    around.ownDirect = 0.0f;
    around.ownBounced = 0.0f;
    return around;
}

// Adds a neighbour, or the probe itself; `brightest`: the largest level among all of them.
KERNEL_FN void addLag(INOUT(LagAround) around, ProbeLag lag, float brightest, bool self) {
    const float share = self ? 1.0f : kSpreadLag;
    const float level = max(max(lag.level, kDarkShare * brightest), 1e-30f);
    around.direct = max(around.direct, share * lag.direct / level);
    around.bounced += lag.bounced;
    around.level += level;
    around.distance = max(around.distance, share * lag.distance);
    if (self) {
        around.ownDirect = lag.direct / level;
        around.ownBounced = lag.bounced / level;
    }
}

// Without fixed rays, the update's own are used: a multiple of the noise of their mean light is subtracted before the
// rest counts as lag. Large changes are followed at once, small ones by the window's limit.
KERNEL_CONST float kOwnRaysNoise = 3.0f;
KERNEL_FN float lagBeyondNoise(float lag, float noise) {
    return sqrt(max(0.0f, lag * lag - kOwnRaysNoise * kOwnRaysNoise * noise * noise));
}

// The lag of a probe's irradiance, as a share of it. Bounced light has the noise of the averages that it comes from,
// common to a room's probes if a small patch lights them all: a deviation that noise of this size explains in an
// average of this window is not lag. Otherwise noise would shorten windows, which makes more noise.
KERNEL_FN float lagOf(float direct, float bounced, float noise, float window, bool ownRays) {
    const float left = noise * noise / max(2.0f * window - 1.0f, 1.0f);
    const float square = kBounceLag * kBounceLag * max(bounced * bounced - left, 0.0f);
    const float lag = sqrt(direct * direct + square);
    return ownRays ? lagBeyondNoise(lag, noise) : lag;
}
KERNEL_FN float filterLag(LagAround around, float noise, float window, bool ownRays) {
    return lagOf(around.direct, around.bounced / max(around.level, 1e-30f), noise, window, ownRays);
}
// The same of what the probe sees itself, whatever its neighbours see.
KERNEL_FN float ownLag(LagAround around, float noise, float window, bool ownRays) {
    return lagOf(around.ownDirect, around.ownBounced, noise, window, ownRays);
}

// What an update tells a schedule of a probe: how far its light may be off, as shares of it. Lag and noise are 0 in
// solid matter, where it does not matter.
struct ProbeProgress {
    float lag;         // that it saw itself, before the update
    float noise;       // standard deviation left in its average, after the update; 0 as long as noise is unknown
    float confidence;  // its window over the longest there is, 0..1
    float level;       // of its light, W sr^-1 m^-2
};

// Of a probe that no update has.
KERNEL_FN ProbeProgress noProgress() {
    ProbeProgress progress;
    progress.lag = 0.0f;
    progress.noise = 0.0f;
    progress.confidence = 0.0f;
    progress.level = 0.0f;
    return progress;
}

KERNEL_FN ProbeProgress probeProgress(float lagSeen, ProbeFilter state, float backfaceShare) {
    const float heard = backfaceShare < kInsideShare + kInsideShareEdge ? 1.0f : 0.0f;
    ProbeProgress progress = noProgress();
    progress.lag = heard * lagSeen;
    progress.noise = heard * state.noise / sqrt(max(2.0f * state.window - 1.0f, 1.0f));
    progress.confidence = state.window / kLongestWindow;
    for (int i = 0; i < kSightLobes; ++i) progress.level += state.direct[i] / float(kSightLobes);
    progress.level = heard * (progress.level + max(state.bounced, 0.0f));
    return progress;
}

// Share of the old value that an update keeps with a window of this length.
KERNEL_FN float keptBy(float window) {
    return 1.0f - 1.0f / max(window, 1.0f);
}

// The window for the next update: as long as its lag does not exceed the noise left in an average of that length, noise
// / sqrt(2 window).
KERNEL_FN float bearableWindow(float wished, float noise, float lag, float longest) {
    const float bearable = noise * noise / max(2.0f * lag * lag, 1e-12f);
    return clamp(min(wished, bearable), 1.0f, max(longest, 1.0f));
}
KERNEL_FN float nextWindow(float window, float noise, float lag, float longest) {
    return bearableWindow(window + min(kWindowGrowth, kYoungGrowth * window), noise, lag, longest);
}

// The window for distances, which have no bounces to wait for. Their noise is not measured but assumed to be
// kDistanceNoise.
KERNEL_CONST float kDistanceNoise = 0.2f;
KERNEL_FN float nextVisibilityWindow(float window, float lag, float longest) {
    return bearableWindow(window + kWindowGrowth, kDistanceNoise, lag, longest);
}

// Blends an update's sight into the averages, at the rates of the filter's windows.
KERNEL_FN void advanceFilter(INOUT(ProbeFilter) state, ProbeSight now) {
    const bool known = !isUnknown(state);
    const float rate = known ? 1.0f / max(state.window, 1.0f) : 1.0f;
    const float distanceRate = known ? 1.0f / max(state.visibilityWindow, 1.0f) : 1.0f;
    for (int i = 0; i < kSightLobes; ++i) state.direct[i] = mix(state.direct[i], now.direct[i], rate);
    state.bounced = known ? mix(state.bounced, now.bounced, rate) : now.bounced;
    for (int i = 0; i < kDistanceLobes; ++i) state.distance[i] = mix(state.distance[i], now.distance[i], distanceRate);
}

// Difference of an update's texels from the average.
struct TexelChange {
    float square;  // sum of squared differences, over channels
    float before;  // sum of the average's texels, over channels
    float now;     // sum of the update's texels
};

KERNEL_FN TexelChange noChange() {
    TexelChange change;
    change.square = 0.0f;
    change.before = 0.0f;
    change.now = 0.0f;
    return change;
}

KERNEL_FN void addTexelChange(INOUT(TexelChange) change, vec3 oldStored, vec3 newMean) {
    const float before = decodeIrradiance(oldStored.x) + decodeIrradiance(oldStored.y) + decodeIrradiance(oldStored.z);
    const float now = newMean.x + newMean.y + newMean.z;
    change.square += (now - before) * (now - before);
    change.before += before;
    change.now += now;
}

KERNEL_FN void joinChanges(INOUT(TexelChange) sum, TexelChange part) {
    sum.square += part.square;
    sum.before += part.before;
    sum.now += part.now;
}

// Mean square difference over the square of the mean.
KERNEL_FN float relativeChange(TexelChange change, int texels) {
    const float level = max(change.before, change.now) / float(texels);
    return change.square / float(texels) / max(level * level, 1e-30f);
}

// Noise after an update whose texels differed from the average by the mean square `change`, relative to the square of
// their mean. Lag is excluded; if it is a large part of the change, noise may fall but not rise. The average's own
// share of noise is subtracted. Without anything to compare with, noise stays unknown (0), and so the window short.
KERNEL_FN float nextNoise(float noise, float change, float lag, float window, bool isNew) {
    if (isNew) return 0.0f;
    const float own = 1.0f + 1.0f / (2.0f * max(window, 1.0f) - 1.0f);
    const float sampled = max(change - lag * lag, 0.0f) / own;
    const float square = noise * noise;
    const float credible = change > kLagInChange * lag * lag ? sampled : min(sampled, square);
    return sqrt(mix(square, credible, noise > 0.0f ? 1.0f / kNoiseWindow : 1.0f));
}

KERNEL_FN uint packLight(float x, uint dither) {
    return packHalfDithered(encodeIrradiance(x), dither);
}
KERNEL_FN float unpackLight(uint bits) {
    return decodeIrradiance(unpackHalf(bits));
}
// An unknown average: packed as 0; known ones are packed as the light's bits plus one. So all bits 0 are the filter of
// a new probe.
KERNEL_CONST float kUnknownLight = -1.0f;

KERNEL_FN uint packWindows(float window, float visibilityWindow) {
    return packHalfDithered(window, 0u) | packHalfDithered(visibilityWindow, 0u) << 16u;
}

KERNEL_FN PackedProbeFilter packFilter(ProbeFilter f, uint seed) {
    // One dither for all: only the averages' expected values matter.
    const uint dither = seed >> 19u;
    PackedProbeFilter packed;
    for (int i = 0; i < 4; ++i)
        packed.words[i] = packLight(f.direct[2 * i], dither) | packLight(f.direct[2 * i + 1], dither) << 16u;
    packed.words[4] = (isUnknown(f) ? 0u : packLight(f.bounced, dither) + 1u) | packHalfDithered(f.noise, dither)
                                                                                    << 16u;
    packed.words[5] = packWindows(f.window, f.visibilityWindow);
    for (int i = 0; i < 2; ++i)
        packed.words[6 + i] =
            packHalfDithered(f.distance[2 * i], dither) | packHalfDithered(f.distance[2 * i + 1], dither) << 16u;
    return packed;
}

KERNEL_FN ProbeFilter unpackFilter(PackedProbeFilter packed) {
    ProbeFilter f;
    for (int i = 0; i < 4; ++i) {
        f.direct[2 * i] = unpackLight(packed.words[i] & 0xffffu);
        f.direct[2 * i + 1] = unpackLight(packed.words[i] >> 16u);
    }
    const uint bounced = packed.words[4] & 0xffffu;
    f.noise = unpackHalf(packed.words[4] >> 16u);
    f.window = unpackHalf(packed.words[5] & 0xffffu);
    f.visibilityWindow = unpackHalf(packed.words[5] >> 16u);
    f.bounced = bounced == 0u ? kUnknownLight : unpackLight(bounced - 1u);
    for (int i = 0; i < 2; ++i) {
        f.distance[2 * i] = unpackHalf(packed.words[6 + i] & 0xffffu);
        f.distance[2 * i + 1] = unpackHalf(packed.words[6 + i] >> 16u);
    }
    return f;
}

KERNEL_FN PackedProbeFilter newFilter() {
    PackedProbeFilter packed;
    for (int i = 0; i < 8; ++i) packed.words[i] = 0u;
    return packed;
}

// Whether a probe has had no update yet: it keeps nothing of what it holds.
KERNEL_FN bool isNew(PackedProbeFilter packed) {
    return packed.words[5] == 0u;
}

// A filter after the updates of an average: the average's window, and unknown light of the fixed rays.
KERNEL_FN PackedProbeFilter forgottenFilter(float window) {
    const float w = clamp(window, 1.0f, kLongestWindow);
    PackedProbeFilter packed = newFilter();
    packed.words[5] = packWindows(w, w);
    return packed;
}

KERNELS_END

#endif
