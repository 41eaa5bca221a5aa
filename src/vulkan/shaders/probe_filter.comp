// After the blend: noise from how far the texels moved, and the fixed rays join their averages. A thread a probe.
#include "filter.glsl"

layout(push_constant, scalar) uniform Push {
    FilterPush push;
};

float changeOf(int probe) {
    TexelChange sum = noChange();
    const int blocks = (push.texels + kIrradianceGroupTexels - 1) / kIrradianceGroupTexels;
    for (int block = 0; block < blocks; ++block)
        joinChanges(sum, TexelChanges(push.changes).at[block * push.probes + probe]);
    return relativeChange(sum, push.texels);
}

void main() {
    const int probe = int(globalIndex());
    if (probe >= push.probes) return;
    if (push.forget != 0) {
        ProbeFilters(push.filters).at[probe] = forgottenFilter(push.longestWindow);
        return;
    }
    ProbeFilter probeFilter = unpackFilter(ProbeFilters(push.filters).at[probe]);
    const float lag = ProbeSteps(push.steps).at[probe].lagShare;
    probeFilter.noise = nextNoise(probeFilter.noise, changeOf(probe), lag, probeFilter.window, isUnknown(probeFilter));
    advanceFilter(probeFilter, ProbeSteps(push.steps).at[probe].sight);
    ProbeFilters(push.filters).at[probe] = packFilter(probeFilter, storageDither(push.ditherSeed, uint(probe)));
}
