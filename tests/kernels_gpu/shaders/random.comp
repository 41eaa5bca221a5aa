#include "lane.h"

#include "kernels/random.h"

// Integers and powers of two: exact on both sides.
void evaluate(INOUT(Lane) lane) {
    const uint a = takeBits(lane);
    const uint b = takeBits(lane);
    giveBits(lane, hashUint(a));
    giveBits(lane, hashCombine(a, b));
    give(lane, uintToUnit(a), 0.0f);
    uint state = a;
    for (int i = 0; i < 8; ++i) give(lane, nextRandom(state), 0.0f);
    giveBits(lane, state);
}
