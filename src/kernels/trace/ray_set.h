// Directions of the update rays: a spherical Fibonacci set (Marques et al. 2013), shared by all probes of a volume. The
// DDGI paper (section 2.3) rotates it at random in every frame. Shifting it measured better: the sets of many frames
// then fill each other's gaps, and their average is nearly that of one set of that many rays, while the noise of
// independent sets falls only with the square root of their number.
#ifndef PROBEGI_KERNELS_RAY_SET_H
#define PROBEGI_KERNELS_RAY_SET_H

#include "kernels/random.h"

KERNELS_BEGIN

KERNEL_CONST float kUnitOf24Bits = 1.0f / 16777216.0f;

// Azimuth of direction `index` in turns, modulo one: 0..1. The product with the golden ratio's reciprocal is in 32-bit
// fixed point, which is exact modulo one turn.
KERNEL_FN float fibonacciTurn(uint index) {
    return float((index * 2654435769u) >> 8u) * kUnitOf24Bits;
}
// The same, -1/2..1/2.
KERNEL_FN float signedTurn(uint index) {
    const float turn = fibonacciTurn(index);
    return turn < 0.5f ? turn : turn - 1.0f;
}

// Direction `index` of `count`, 0 <= index < count, of the set shifted by `shift`, both 0..1: cos(theta) =
// 1 - 2 (i + shift.x) / N, phi = 2 pi frac(i / golden ratio + shift.y).
KERNEL_FN vec3 shiftedFibonacci(uint index, uint count, vec2 shift) {
    const float turn = fibonacciTurn(index) + shift.y;
    const float phi = 2.0f * kPi * (turn - floor(turn));
    const float cosTheta = 1.0f - 2.0f * (float(index) + shift.x) / float(count);
    const float sinTheta = sqrt(max(0.0f, 1.0f - cosTheta * cosTheta));
    return vec3(cos(phi) * sinTheta, sin(phi) * sinTheta, cosTheta);
}

// The set as published.
KERNEL_FN vec3 sphericalFibonacci(uint index, uint count) {
    return shiftedFibonacci(index, count, vec2(0.5f, 0.0f));
}

// The shift of frame `frame` of a volume with seed `seed`, for a set of `count`. On the equal-area cylinder of
// cos(theta) and phi, the set is a lattice: shifts that are uniform over one of its cells cover the sphere uniformly.
// The cell's sides are steps by two consecutive Fibonacci numbers of rays, which lead to the nearest directions at the
// equator; the position in the cell follows a Kronecker sequence with the powers of the plastic number (Roberts' R2)
// from a random start. All modulo 1, in 32-bit fixed point.
KERNEL_FN vec2 frameShift(uint seed, uint frame, uint count) {
    const uint state = hashCombine(hashUint(seed), 0x2545f491u);
    const uint a = (hashUint(state) + frame * 3242174889u) >> 8u;
    const uint b = (hashUint(state + 1u) + frame * 2447445414u) >> 8u;
    uint shorter = 1u;
    uint longer = 1u;
    while (float(longer * longer) < 1.405f * float(count)) {  // pi / sqrt(5)
        const uint sum = shorter + longer;
        shorter = longer;
        longer = sum;
    }
    const uint along = a * shorter + b * longer;  // counts are at most 4096: below 2^32
    const float turns = float(a) * kUnitOf24Bits * signedTurn(shorter) + float(b) * kUnitOf24Bits * signedTurn(longer) -
                        signedTurn(along >> 24u);
    return vec2(float(along & 0xffffffu) * kUnitOf24Bits, turns - floor(turns));
}

// Uniformly distributed rotation from three independent numbers in [0, 1) (Shoemake 1992, "Uniform Random Rotations").
KERNEL_FN mat3 randomRotation(float u1, float u2, float u3) {
    const float a = sqrt(1.0f - u1);
    const float b = sqrt(u1);
    const float x = a * sin(2.0f * kPi * u2);
    const float y = a * cos(2.0f * kPi * u2);
    const float z = b * sin(2.0f * kPi * u3);
    const float w = b * cos(2.0f * kPi * u3);
    return mat3(vec3(1.0f - 2.0f * (y * y + z * z), 2.0f * (x * y + w * z), 2.0f * (x * z - w * y)),
                vec3(2.0f * (x * y - w * z), 1.0f - 2.0f * (x * x + z * z), 2.0f * (y * z + w * x)),
                vec3(2.0f * (x * z + w * y), 2.0f * (y * z - w * x), 1.0f - 2.0f * (x * x + y * y)));
}

// The rotation of frame `frame` of a volume with seed `seed`.
KERNEL_FN mat3 frameRotation(uint seed, uint frame) {
    uint state = hashCombine(hashUint(seed), frame);
    const float u1 = nextRandom(state);
    const float u2 = nextRandom(state);
    const float u3 = nextRandom(state);
    return randomRotation(u1, u2, u3);
}

// An update's directions in a few numbers, for shaders that trace the rays.
struct RaySet {
    vec3 turned[3];  // the axes after the rotation
    vec2 shift;      // shiftedFibonacci()
    int count;       // raysPerProbe
    int fixedCount;  // of fixed rays; 0: none
};

// 0 <= index < count: FieldControl::rayDirections().
KERNEL_FN vec3 rayOfSet(IN(RaySet) set, int index) {
    return mat3(set.turned[0], set.turned[1], set.turned[2]) *
           shiftedFibonacci(uint(index), uint(set.count), set.shift);
}

// 0 <= index < fixedCount: FieldControl::fixedRayDirections().
KERNEL_FN vec3 fixedRayOfSet(IN(RaySet) set, int index) {
    return sphericalFibonacci(uint(index), uint(set.fixedCount));
}

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(sizeof(RaySet) == 52 && offsetof(RaySet, shift) == 36);
}  // namespace probegi::kernels
#endif

#endif
