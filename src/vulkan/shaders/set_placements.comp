// Where the probes stand from now on, and those among them that know nothing. One thread per probe.
#include "renew_probe.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Placements {
    GpuPlacement at[];
};

layout(push_constant, scalar) uniform Push {
    PlacementsPush push;
};

void main() {
    const uint slot = globalIndex();
    if (slot >= push.count) return;
    const GpuPlacement placement = Placements(push.placements).at[slot];
    probegiStates.at[slot].placement = placement.word;
    if (placement.renewed != 0u) renewProbe(int(slot), push.sides, push.filters);
}
