#include "lane.h"

#include "kernels/probe/probe_state.h"

void evaluate(INOUT(Lane) lane) {
    const uint placement = takeBits(lane);
    const uint state = takeBits(lane) % kProbeStates;
    const uint event = takeBits(lane) % kProbeEvents;
    const uint next = nextProbeState(state, event);
    giveBits(lane, next);
    giveBits(lane, (isActive(next) ? 1u : 0u) + (isUnused(next) ? 2u : 0u));
    giveBits(lane, withState(placement, state));
    giveBits(lane, stateOf(placement));
    giveBits(lane, looksOf(placement));
}
