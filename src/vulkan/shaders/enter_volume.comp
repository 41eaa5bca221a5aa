// Probes that entered a volume with a step of scrolling know nothing. One thread per probe of the volume.
#include "renew_probe.glsl"

layout(push_constant, scalar) uniform Push {
    EnterPush push;
};

void main() {
    const Volume volume = probegiField.volumes[push.volume];
    const uint index = globalIndex();
    if (index >= uint(volumeProbes(volume))) return;
    const int slot = volume.firstSlot + int(index);
    if (!hasEntered(volume, probeCell(volume, slot), push.cells)) return;
    renewProbe(slot, push.sides, push.filters);
    probegiStates.at[slot].placement = 0u;
    if (push.surfaces != uvec2(0u)) Uints(push.surfaces).at[slot] = 0u;
}
