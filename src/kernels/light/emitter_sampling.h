// Points on emitters that a probe looks at besides its update rays, and how the two ways of meeting an emitter share
// its light: multiple importance sampling with the power heuristic (Veach 1997, sections 9.2.2 and 9.2.4), its exponent
// 4, and the densities taken as if every emitter faced the probe. Both keep looks away from where rays already do well:
// they are spread evenly and far less noisy than their number says. Measured, deviation of one update over its mean
// with 4 looks, balance heuristic / exponent 2 / this: furnace with 32 rays 2.7 / 0.84 / 0.13 % (0.12 % without looks),
// Cornell box with 144 rays 10.4 / 9.1 / 9.7 % (54 % without).
#ifndef PROBEGI_KERNELS_EMITTER_SAMPLING_H
#define PROBEGI_KERNELS_EMITTER_SAMPLING_H

#include "kernels/random.h"
#include "kernels/sampling.h"
#include "kernels/shade/surface.h"

KERNELS_BEGIN

// What one look at an emitter brings to its probe: a texel in direction n gains max(0, n . direction) * light of mean
// radiance, besides what the update rays bring.
struct EmitterLight {
    vec3 direction;  // unit, from the probe
    vec3 light;      // W sr^-1 m^-2; 0 where the emitter is not seen
};

// Of all looks of a probe in a frame.
KERNEL_FN uint emitterSeed(uint frameSeed, uint probe) {
    return hashCombine(frameSeed ^ 0x3c6ef372u, probe);
}

// The number that chooses an emitter for look `index` of `count` (1..16): anywhere in the index-th of `count` equal
// parts of the 32-bit numbers.
KERNEL_FN uint emitterChoice(uint seed, uint index, uint count) {
    return index * (0xffffffffu / count) + hashCombine(seed, index) / count;
}

// Where on the chosen triangle, uniform over its area: weights of the second and third corner. The triangle is chosen
// by numbers above `below` up to `upTo`. How far the choice lies between them is one coordinate, so that the looks at
// a lamp of few triangles are spread over it; multiples of the golden ratio from a random start are the other.
KERNEL_FN vec2 emitterBarycentric(uint seed, uint index, uint choice, uint below, uint upTo) {
    const float along = float(choice - below) / float(max(upTo - below, 1u));
    const float across = uintToUnit(hashUint(seed) + index * 2654435769u);
    return sampleTriangle(vec2(min(along, 1.0f), across));
}

// A point on an emitter as its probe sees it.
struct EmitterAim {
    vec3 direction;  // unit, from the probe
    float distance;  // metres
    float cosine;    // between the direction and the triangle's normal, 0..1; 0: there is nothing to see
};

KERNEL_FN EmitterAim aimAtEmitter(vec3 probe, vec3 corner, vec3 edge1, vec3 edge2, vec2 barycentric) {
    const vec3 apart = (corner - probe) + edge1 * barycentric.x + edge2 * barycentric.y;
    EmitterAim aim;
    aim.distance = length(apart);
    aim.direction = unitOr(apart, vec3(0.0f, 0.0f, 1.0f));
    aim.cosine = abs(dot(unitOr(cross(edge1, edge2), vec3(0.0f)), aim.direction));
    return aim;
}

// How far from the expected distance a ray may meet the point: `offset` is what positions are known to (rayOffset).
KERNEL_FN float emitterTolerance(EmitterAim aim, float offset) {
    return 1e-4f * aim.distance + 4.0f * offset / max(aim.cosine, 0.05f);
}

// Density per steradian of all update rays of a probe together.
KERNEL_FN float rayDensity(int rays) {
    return float(rays) * (0.25f / kPi);
}

// The same of all looks at a point that faces the probe, where `perArea` is the density of each per square metre.
KERNEL_FN float lookDensity(int looks, float perArea, float distance) {
    return float(looks) * perArea * (distance * distance);
}

// Share of the light of a point in favour of the way of meeting it that has density `own`.
KERNEL_FN float emissionShare(float own, float other) {
    if (!(own > 0.0f)) return 0.0f;
    const float ratio = min(other / own, 1e9f);  // its fourth power stays finite
    return 1.0f / (1.0f + (ratio * ratio) * (ratio * ratio));
}

// Share of an emission that counts for an update ray which meets it at this distance.
KERNEL_FN float rayEmissionShare(int rays, int looks, float perArea, float distance) {
    return emissionShare(rayDensity(rays), lookDensity(looks, perArea, distance));
}

// What the radiance that a look meets is to be multiplied with: its share, over the density of all looks, over pi (for
// the mean of radiance that a cosine weights).
KERNEL_FN float emitterLightFactor(int rays, int looks, float perArea, EmitterAim aim) {
    const float facing = lookDensity(looks, perArea, aim.distance);
    return emissionShare(facing, rayDensity(rays)) * aim.cosine / (kPi * max(facing, 1e-30f));
}

KERNELS_END

#endif
