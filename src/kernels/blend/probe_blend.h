// The update of a probe's texels from its rays (DDGI paper, section 2.3, eq. 1, Listings 1 and 3).
#ifndef PROBEGI_KERNELS_PROBE_BLEND_H
#define PROBEGI_KERNELS_PROBE_BLEND_H

#include "kernels/probe/irradiance_encoding.h"

KERNELS_BEGIN

// RayDatum::distance of a ray that hit nothing is at least this.
KERNEL_CONST float kMissDistance = 1e27f;
// Bits of 1e30f and of infinity. NaN and infinity are tested by their bits, since a shader compiler may assume that
// they do not occur.
KERNEL_CONST uint kTooBrightBits = 0x7149f2cau;
KERNEL_CONST uint kInfinityBits = 0x7f800000u;

// A channel of a ray's radiance: NaN, infinite, negative values and values above 1e30 never enter an atlas.
KERNEL_FN float safeRadiance(float x) {
    return select(floatBitsToUint(x) < kTooBrightBits, x, 0.0f);
}

// A ray's distance; NaN is a miss.
KERNEL_FN float safeDistance(float signedDistance) {
    return select((floatBitsToUint(signedDistance) & 0x7fffffffu) > kInfinityBits, 1e30f, signedDistance);
}

// Whether a ray hit the back of a surface, by winding: the sign of its safe distance, even at distance 0.
KERNEL_FN bool hitBack(float safeSignedDistance) {
    return (floatBitsToUint(safeSignedDistance) & 0x80000000u) != 0u;
}

// Whether that surface is single-sided, so that its back is solid wall. For the back of a double-sided surface,
// radiance and distance are both negated.
KERNEL_FN bool hitBackface(float safeSignedDistance, float signedRed) {
    return hitBack(safeSignedDistance) && (floatBitsToUint(signedRed) & 0x80000000u) == 0u;
}

// Radiance that arrives along a ray, from its datum; 0 from a backface.
KERNEL_FN vec3 arrivingRadiance(float safeSignedDistance, vec3 signedRadiance) {
    const bool back = hitBack(safeSignedDistance);
    const vec3 light = back ? -signedRadiance : signedRadiance;
    const bool dark = back && hitBackface(safeSignedDistance, signedRadiance.x);
    return dark ? vec3(0.0f) : vec3(safeRadiance(light.x), safeRadiance(light.y), safeRadiance(light.z));
}

// The radiance of a datum for the back of a double-sided surface. Black becomes a tiny value, since the sign of 0 is
// not reliably preserved.
KERNEL_FN vec3 radianceFromBack(vec3 radiance) {
    return -max(radiance, vec3(1e-30f));
}

// Share of a probe's hits that were on backfaces.
KERNEL_FN float backfaceShareOf(int backfaces, int hits) {
    return select(hits > 0, float(backfaces) / float(max(hits, 1)), 0.0f);
}

// Normalisation factor for weights of this sum. A texel that no ray comes near (few rays, high exponent) keeps weight 0
// throughout.
KERNEL_FN float normalisingFactor(float weightSum) {
    return select(weightSum > 1e-20f, 1.0f / max(weightSum, 1e-20f), 0.0f);
}

// BackfaceRule::excluded: renormalises over the weights of the rays that count, `validity`, instead of all weights.
KERNEL_FN float withoutBackfaces(float mean, float validity) {
    return mean / max(validity, 1e-6f);
}

// Weight of a ray for an irradiance texel: the clamped cosine of eq. 1 (the caller normalises by the sum of weights).
KERNEL_FN float irradianceWeight(vec3 texelDirection, vec3 rayDirection) {
    return max(0.0f, dot(texelDirection, rayDirection));
}

// Visibility weights below this share of a texel's largest are dropped: nine in ten are powers of small cosines, many
// of them denormals, which cost some processors a hundred cycles each.
KERNEL_CONST float kNegligibleWeight = 1e-8f;

// Cosine at which a ray's weight is negligible, where `nearest` is the largest cosine of all rays.
KERNEL_FN float leastVisibilityCosine(float nearest, float exponent) {
    return max(nearest, 0.0f) * pow(kNegligibleWeight, 1.0f / exponent);
}

// Weight of a ray for a visibility texel: the power cosine of section 2.3. By repeated squaring, which is the same
// everywhere: pow() with exponent 200 differs between processors in the fifth digit.
KERNEL_FN float visibilityWeight(vec3 texelDirection, vec3 rayDirection, float exponent) {
    const float cosine = max(0.0f, dot(texelDirection, rayDirection));
    const float whole = floor(exponent);
    float power = exponent > whole ? pow(cosine, exponent - whole) : 1.0f;
    float square = cosine;
    for (uint bits = uint(whole); bits != 0u; bits >>= 1u) {
        if ((bits & 1u) != 0u) power *= square;
        square *= square;
    }
    return power;
}

// Evidence of an update's rays for a visibility texel, relative to the average for uniformly spread rays: the sum of
// their weights over its mean, since the power cosine's mean over all directions is 1 / (2 (exponent + 1)). With few
// rays, even the nearest may say little about a texel between them.
KERNEL_FN float visibilityEvidence(float weightSum, float exponent, int rays) {
    return weightSum * 2.0f * (exponent + 1.0f) / float(rays);
}

// Share of a texel's old moments that is kept, where `kept` is that of its probe: old and new are weighted by their
// evidence. A probe that keeps nothing keeps nothing of any texel.
KERNEL_FN float keptMoments(float kept, float evidence) {
    return kept > 0.0f ? max(0.0f, 1.0f - (1.0f - kept) * evidence) : 0.0f;
}

// A ray's distance for the visibility map, in units of `maxDistance`, 0..1. A backface (negative distance) counts with
// a fifth of its distance: "shorten their depth values by 80%" (section 4.1).
KERNEL_FN float visibilityDistance(float signedDistance, float maxDistance) {
    const float d = signedDistance < 0.0f ? -0.2f * signedDistance : signedDistance;
    return min(d, maxDistance) / maxDistance;
}

struct BlendRule {
    float hysteresis;         // alpha of eq. 1
    float significantChange;  // Listing 3; 0 disables
    float newDistribution;    // Listing 3; 0 disables
};

// Listing 3: the hysteresis of one texel, from its old and new encoded value. The paper's thresholds are relative to
// the "maximum value" of a format that ends at 1; here the maximum is the larger of the two texels, so that the rule is
// the same at every brightness.
KERNEL_FN float texelHysteresis(vec3 oldStored, vec3 newStored, BlendRule rule) {
    const vec3 change = abs(newStored - oldStored);
    const float magnitude = max(change.x, max(change.y, change.z));
    const vec3 larger = max(newStored, oldStored);
    const float scale = max(larger.x, max(larger.y, larger.z));
    float h = rule.hysteresis;
    h = select(rule.significantChange > 0.0f && magnitude > rule.significantChange * scale, max(0.0f, h - 0.15f), h);
    return select(rule.newDistribution > 0.0f && magnitude > rule.newDistribution * scale, 0.0f, h);
}

// Listing 1: blends in the encoded space, where darkening is perceptually linear. `newMean` is linear.
KERNEL_FN vec3 blendEncoded(vec3 oldStored, vec3 newMean, BlendRule rule) {
    const vec3 newStored = vec3(encodeIrradiance(newMean.x), encodeIrradiance(newMean.y), encodeIrradiance(newMean.z));
    return mix(newStored, oldStored, texelHysteresis(oldStored, newStored, rule));
}

// The same in linear space: unbiased, for averages of a static scene (the mean of fifth roots of noisy values is lower
// than the fifth root of their mean).
KERNEL_FN vec3 blendLinear(vec3 oldStored, vec3 newMean, float hysteresis) {
    const vec3 oldMean =
        vec3(decodeIrradiance(oldStored.x), decodeIrradiance(oldStored.y), decodeIrradiance(oldStored.z));
    const vec3 mean = mix(newMean, oldMean, hysteresis);
    return vec3(encodeIrradiance(mean.x), encodeIrradiance(mean.y), encodeIrradiance(mean.z));
}

KERNELS_END

#endif
