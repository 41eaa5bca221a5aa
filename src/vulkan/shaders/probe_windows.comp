// Each probe's windows for the blend that follows, from its own and its neighbours' lag. One thread per probe.
#include "filter.glsl"
#include "tasks.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    FilterPush push;
};

ProbeLag lagAt(Volume volume, ivec3 cell) {
    return ProbeSteps(push.steps).at[probeSlot(volume, cell)].lag;
}

LagAround lagAround(Volume volume, ivec3 at) {
    const ivec3 lowest = max(at - 1, ivec3(0));
    const ivec3 highest = min(at + 1, volume.counts - 1);
    float brightest = 0.0;
    for (int z = lowest.z; z <= highest.z; ++z)
        for (int y = lowest.y; y <= highest.y; ++y)
            for (int x = lowest.x; x <= highest.x; ++x) brightest = max(brightest, lagAt(volume, ivec3(x, y, z)).level);
    LagAround around = noLag();
    for (int z = lowest.z; z <= highest.z; ++z)
        for (int y = lowest.y; y <= highest.y; ++y)
            for (int x = lowest.x; x <= highest.x; ++x)
                addLag(around, lagAt(volume, ivec3(x, y, z)), brightest, ivec3(x, y, z) == at);
    return around;
}

void main() {
    const uint index = globalIndex();
    if (index >= Tasks(push.tasks).counts.tasks) return;
    const ProbeTask task = Tasks(push.tasks).at[index];
    const Volume volume = probegiField.volumes[task.volume];
    const uint probe = task.slot;
    ProbeFilter probeFilter = unpackFilter(ProbeFilters(push.filters).at[probe]);
    const LagAround around = lagAround(volume, probeCell(volume, int(probe)));
    const float lag = filterLag(around, probeFilter.noise, probeFilter.window, push.ownRays != 0);
    ProbeSteps(push.steps).at[probe].ownLag = ownLag(around, probeFilter.noise, probeFilter.window, push.ownRays != 0);
    if (push.settles == 0) {
        probeFilter.window = nextWindow(probeFilter.window, probeFilter.noise, lag, push.longestWindow);
        probeFilter.visibilityWindow =
            nextVisibilityWindow(probeFilter.visibilityWindow, around.distance, push.longestVisibilityWindow);
    }
    ProbeFilters(push.filters).at[probe].words[5] = packWindows(probeFilter.window, probeFilter.visibilityWindow);
    ProbeSteps(push.steps).at[probe].lagShare = lag;
    const bool settles = push.settles != 0;
    ProbeSteps(push.steps).at[probe].irradianceKept = settles ? 1.0 : keptBy(probeFilter.window);
    ProbeSteps(push.steps).at[probe].visibilityKept = settles ? 1.0 : keptBy(probeFilter.visibilityWindow);
}
