// A new probe's way to its place and its first state (sections 5 and 6.3), in its placement word (probe_state.h).
#ifndef PROBEGI_KERNELS_PLACING_H
#define PROBEGI_KERNELS_PLACING_H

#include "kernels/probe/probe_state.h"
#include "kernels/probe/relocation.h"
#include "kernels/volume/placed_probe.h"

KERNELS_BEGIN

// Forgets looks of an earlier placing that was not ended.
KERNEL_FN uint beginPlacing(uint placement) {
    return placement & ~(kLookBits | kInsideBit);
}

// After one look by `counted` rays: what they told, and unless it was the last one the next place.
KERNEL_FN uint lookedAround(Volume v, uint placement, PlaceSight sight, int counted, bool relocates, int rules) {
    uint next = (placement & ~kInsideBit) + kOneLook;
    if (isOff(sight.seen, counted, rules)) next |= kInsideBit;
    if (looksOf(next) >= looksOfPlacement(relocates)) return next;
    const vec3 offset = relocated(probeOffset(v, int(next)), sight, counted, v.spacing, v.minSpacing, rules);
    return withOffset(v, next, offset);
}

// Whether all looks are done.
KERNEL_FN bool isPlaced(uint placement, bool relocates) {
    return looksOf(placement) >= looksOfPlacement(relocates);
}

// The event that ends it. `used`: a static surface uses the probe; `sleeps`: FieldDesc::probeStates.
KERNEL_FN uint placedEvent(uint placement, bool used, bool sleeps) {
    if (!sleeps) return kSurfaceFound;
    if ((placement & kInsideBit) != 0u) return kPlacedInside;
    return used ? kSurfaceFound : kPlacedInOpen;
}

KERNELS_END

#endif
