// Probe states (section 6, Figure 7, Listing 5): which probes are updated. A probe whose cells hold no surface is asked
// by none, and sleeps; one that no relocation brings out of a wall is off. The state is the lowest byte of a probe's
// placement word, beside what is known of its surroundings.
#ifndef PROBEGI_KERNELS_PROBE_STATE_H
#define PROBEGI_KERNELS_PROBE_STATE_H

#include "kernels/language.h"

KERNELS_BEGIN

// In the order of probegi::ProbeActivity.
KERNEL_CONST uint kUninitialized = 0u;  // not placed yet
KERNEL_CONST uint kOff = 1u;            // inside static geometry
KERNEL_CONST uint kSleeping = 2u;       // no surface within its cells
KERNEL_CONST uint kNewlyAwake = 3u;     // awake from its next update on
KERNEL_CONST uint kNewlyVigilant = 4u;  // vigilant from its next update on
KERNEL_CONST uint kAwake = 5u;          // near something that moves, or in a medium
KERNEL_CONST uint kVigilant = 6u;       // static surfaces use it: always updated
KERNEL_CONST uint kProbeStates = 7u;

// What happens to a probe.
KERNEL_CONST uint kPlacedInside = 0u;  // placed, inside static geometry
KERNEL_CONST uint kPlacedInOpen = 1u;  // placed, no static surface within its cells
KERNEL_CONST uint kSurfaceFound = 2u;  // placed, or found by a later ray: a static surface uses it
KERNEL_CONST uint kMoverNear = 3u;     // the extended bounds of something that moves, or of a medium, hold it
KERNEL_CONST uint kMoverGone = 4u;     // none do
KERNEL_CONST uint kUpdated = 5u;
KERNEL_CONST uint kEntered = 6u;  // it took another's slot: its window scrolled
KERNEL_CONST uint kProbeEvents = 7u;

// Figure 7. What is not among its transitions leaves a probe as it is. Off is for good: only static geometry turns
// probes off, and it does not move.
KERNEL_FN uint nextProbeState(uint state, uint event) {
    if (event == kEntered) return kUninitialized;
    if (state == kUninitialized) {
        if (event == kPlacedInside) return kOff;
        if (event == kPlacedInOpen) return kSleeping;
        return event == kSurfaceFound ? kNewlyVigilant : state;
    }
    if (state == kOff || state == kVigilant) return state;
    if (event == kUpdated) {
        if (state == kNewlyAwake) return kAwake;
        return state == kNewlyVigilant ? kVigilant : state;
    }
    if (event == kSurfaceFound) return state == kAwake ? kVigilant : kNewlyVigilant;
    if (event == kMoverNear) return state == kSleeping ? kNewlyAwake : state;
    if (event == kMoverGone) return state == kNewlyAwake || state == kAwake ? kSleeping : state;
    return state;
}

// Whether an update traces and blends the probe. One that is not placed yet is among them only where the caller traces
// the rays, since these place it.
KERNEL_FN bool isActive(uint state) {
    return state >= kNewlyAwake;
}
// Whether look-ups pass the probe over until it is updated again.
KERNEL_FN bool isUnused(uint state) {
    return state <= kSleeping;
}

// The placement word's lowest byte: the state; while the probe is being placed also how often its rays were looked at,
// and what they told.
KERNEL_CONST uint kStateBits = 0x07u;
KERNEL_CONST uint kLookBits = 0x38u;
KERNEL_CONST uint kOneLook = 0x08u;
KERNEL_CONST uint kInsideBit = 0x40u;   // its last rays saw it inside static geometry
KERNEL_CONST uint kSurfaceBit = 0x80u;  // a static surface uses it
KERNEL_CONST uint kPlacingBits = 0xf8u;

KERNEL_FN uint stateOf(uint placement) {
    return placement & kStateBits;
}
KERNEL_FN uint withState(uint placement, uint state) {
    return (placement & ~kStateBits) | state;
}
KERNEL_FN uint looksOf(uint placement) {
    return (placement & kLookBits) / kOneLook;
}

KERNELS_END

#endif
