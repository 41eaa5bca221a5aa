// The states of the coming update (DDGI paper, section 6, Listing 5): those that were updated are no longer new, those
// that were placed begin, those near moving things are awake. One thread per probe.
#include "renew_probe.glsl"

#include "places.glsl"

// Whether something that moves, or a medium, may ask for the probe.
bool isNear(Volume v, int slot) {
    const ivec3 cell = probeCell(v, slot);
    const vec3 reach = moverReach(v, probegiField.selfShadowBias, probegiField.rules);
    for (uint i = 0u; i < push.moving + push.media; ++i) {
        const GpuBounds b = BoundsList(push.boxes).at[i];
        if (isNearBox(v, cell, boxInVolume(v, b.lower, b.upper), reach)) return true;
    }
    return false;
}

void main() {
    const uint index = globalIndex();
    if (index >= push.slots) return;
    const int slot = int(index);
    uint placement = probegiStates.at[slot].placement;
    const uint before = stateOf(placement);
    const bool used = Uints(push.surfaces).at[slot] != 0u;
    bool forgets = before == kUninitialized;
    if (before != kUninitialized) {
        placement = withState(placement, nextProbeState(before, kUpdated));
        if (used) placement = withState(placement, nextProbeState(stateOf(placement), kSurfaceFound));
    } else if (isPlaced(placement, relocates())) {
        const uint first = nextProbeState(kUninitialized, placedEvent(placement, used, sleeps()));
        placement = withState(placement & ~kPlacingBits, first);
    }
    if (sleeps()) {
        const Volume v = probegiField.volumes[probegiVolumeOf(slot)];
        const uint event = isNear(v, slot) ? kMoverNear : kMoverGone;
        placement = withState(placement, nextProbeState(stateOf(placement), event));
    }
    if (isUnused(stateOf(placement)) && !isUnused(before)) forgets = true;
    probegiStates.at[slot].placement = placement;
    if (forgets) renewProbe(slot, push.sides, push.filters);
}
