// Counter-based random numbers: a pure function of their purpose, so that any order of evaluation and any number
// of threads gives the same values.
#ifndef PROBEGI_KERNELS_RANDOM_H
#define PROBEGI_KERNELS_RANDOM_H

#include "kernels/language.h"

KERNELS_BEGIN

// One round of the PCG output permutation as a hash (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", the
// `pcg` entry of their table 1).
KERNEL_FN uint hashUint(uint x) {
    const uint state = x * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

KERNEL_FN uint hashCombine(uint a, uint b) {
    return hashUint(a ^ (b + 0x9e3779b9u + (a << 6u) + (a >> 2u)));
}

// 0 <= result < 1, from the top 24 bits.
KERNEL_FN float uintToUnit(uint x) {
    return float(x >> 8u) * (1.0f / 16777216.0f);
}

// A stream of random numbers: `state` is advanced.
KERNEL_FN float nextRandom(INOUT(uint) state) {
    state = state * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return uintToUnit((word >> 22u) ^ word);
}

KERNELS_END

#endif
