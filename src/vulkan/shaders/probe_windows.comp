// Each probe's windows for the coming blend, from its own and its neighbours' lag. A thread a probe.
#include "filter.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    FilterPush push;
};

ProbeLag lagAt(ivec3 cell) {
    return ProbeSteps(push.steps).at[probeNumber(cell, probegiVolume.counts)].lag;
}

LagAround lagAround(ivec3 at) {
    const ivec3 lowest = max(at - 1, ivec3(0));
    const ivec3 highest = min(at + 1, probegiVolume.counts - 1);
    float brightest = 0.0;
    for (int z = lowest.z; z <= highest.z; ++z)
        for (int y = lowest.y; y <= highest.y; ++y)
            for (int x = lowest.x; x <= highest.x; ++x) brightest = max(brightest, lagAt(ivec3(x, y, z)).level);
    LagAround around = noLag();
    for (int z = lowest.z; z <= highest.z; ++z)
        for (int y = lowest.y; y <= highest.y; ++y)
            for (int x = lowest.x; x <= highest.x; ++x)
                addLag(around, lagAt(ivec3(x, y, z)), brightest, ivec3(x, y, z) == at);
    return around;
}

void main() {
    const int probe = int(globalIndex());
    if (probe >= push.probes) return;
    ProbeFilter probeFilter = unpackFilter(ProbeFilters(push.filters).at[probe]);
    const LagAround around = lagAround(gpuProbeCell(probe, probegiVolume.counts));
    const float lag = filterLag(around, probeFilter.noise, probeFilter.window, push.ownRays != 0);
    probeFilter.window = nextWindow(probeFilter.window, probeFilter.noise, lag, push.longestWindow);
    probeFilter.visibilityWindow =
        nextVisibilityWindow(probeFilter.visibilityWindow, around.distance, push.longestVisibilityWindow);
    ProbeFilters(push.filters).at[probe].words[5] = packWindows(probeFilter.window, probeFilter.visibilityWindow);
    ProbeSteps(push.steps).at[probe].lagShare = lag;
    ProbeSteps(push.steps).at[probe].irradianceKept = keptBy(probeFilter.window);
    ProbeSteps(push.steps).at[probe].visibilityKept = keptBy(probeFilter.visibilityWindow);
}
