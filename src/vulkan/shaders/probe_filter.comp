// After the blend: estimates the noise from the change of the texels and adds the fixed rays to their averages. One
// thread per probe.
#include "filter.glsl"
#include "tasks.glsl"
#include "volume.glsl"

layout(push_constant, scalar) uniform Push {
    FilterPush push;
};

float changeOf(uint task, uint tasks) {
    TexelChange sum = noChange();
    const int blocks = (push.texels + kIrradianceGroupTexels - 1) / kIrradianceGroupTexels;
    for (int block = 0; block < blocks; ++block)
        joinChanges(sum, TexelChanges(push.changes).at[uint(block) * tasks + task]);
    return relativeChange(sum, push.texels);
}

void main() {
    const uint index = globalIndex();
    const uint tasks = Tasks(push.tasks).counts.tasks;
    if (index >= tasks) return;
    const ProbeTask task = Tasks(push.tasks).at[index];
    const uint probe = task.slot;
    if (push.forget != 0) {
        ProbeFilters(push.filters).at[probe] = forgottenFilter(push.longestWindow);
        return;
    }
    const uint number = uint(probeNumber(probegiField.volumes[task.volume], int(probe)));
    ProbeFilter probeFilter = unpackFilter(ProbeFilters(push.filters).at[probe]);
    const float lag = ProbeSteps(push.steps).at[probe].lagShare;
    probeFilter.noise = nextNoise(probeFilter.noise, changeOf(index, tasks), lag, probeFilter.window,
                                  push.settles == 0 && isUnknown(probeFilter));
    advanceFilter(probeFilter, ProbeSteps(push.steps).at[probe].sight);
    ProbeFilters(push.filters).at[probe] = packFilter(probeFilter, storageDither(push.ditherSeed, number));
    if (push.progress != uvec2(0u))
        ProbeProgresses(push.progress).at[probe] =
            probeProgress(ProbeSteps(push.steps).at[probe].ownLag, probeFilter, probegiStates.at[probe].backfaceShare);
}
