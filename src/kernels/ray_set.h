// Directions of the update rays: a spherical Fibonacci set (Marques et al. 2013) under one random rotation a frame
// (DDGI paper, section 2.3), shared by all probes of a volume.
#ifndef PROBEGI_KERNELS_RAY_SET_H
#define PROBEGI_KERNELS_RAY_SET_H

#include "kernels/random.h"

KERNELS_BEGIN

// Direction `index` of `count`, 0 <= index < count: cos(theta) = 1 - (2 i + 1) / N, phi = 2 pi frac(i / golden ratio).
// The product with the golden ratio's reciprocal is taken in 32-bit fixed point, which is exact modulo one turn.
KERNEL_FN vec3 sphericalFibonacci(uint index, uint count) {
    const float turn = float((index * 2654435769u) >> 8u) * (1.0f / 16777216.0f);
    const float phi = 2.0f * kPi * turn;
    const float cosTheta = 1.0f - (2.0f * float(index) + 1.0f) / float(count);
    const float sinTheta = sqrt(max(0.0f, 1.0f - cosTheta * cosTheta));
    return vec3(cos(phi) * sinTheta, sin(phi) * sinTheta, cosTheta);
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

KERNELS_END

#endif
