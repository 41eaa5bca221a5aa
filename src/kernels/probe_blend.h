// The update of a probe's texels from its rays (DDGI paper, section 2.3, eq. 1, Listings 1 and 3).
#ifndef PROBEGI_KERNELS_PROBE_BLEND_H
#define PROBEGI_KERNELS_PROBE_BLEND_H

#include "kernels/irradiance_encoding.h"

KERNELS_BEGIN

// Weight of a ray for an irradiance texel: the clamped cosine of eq. 1 (normalised by the caller with the sum of
// weights).
KERNEL_FN float irradianceWeight(vec3 texelDirection, vec3 rayDirection) {
    return max(0.0f, dot(texelDirection, rayDirection));
}

// Weight of a ray for a visibility texel: the power cosine of section 2.3.
KERNEL_FN float visibilityWeight(vec3 texelDirection, vec3 rayDirection, float exponent) {
    return pow(max(0.0f, dot(texelDirection, rayDirection)), exponent);
}

// Distance of a ray as the visibility map averages it, in units of `maxDistance`, 0..1. A backface (negative distance)
// counts with a fifth of its distance: "shorten their depth values by 80%" (section 4.1).
KERNEL_FN float visibilityDistance(float signedDistance, float maxDistance) {
    const float d = signedDistance < 0.0f ? -0.2f * signedDistance : signedDistance;
    return min(d, maxDistance) / maxDistance;
}

struct BlendRule {
    float hysteresis;         // alpha of eq. 1
    float significantChange;  // Listing 3; 0 disables
    float newDistribution;    // Listing 3; 0 disables
};

// Listing 3: the hysteresis of one texel, from its old and new encoded value. The paper's thresholds are shares of the
// "maximum value" of a format that ends at 1; here the maximum is the larger of the two texels, so that the rule is
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

// Listing 1: blends in the encoded space, where a fall to dark is perceptually linear. `newMean` is linear.
KERNEL_FN vec3 blendEncoded(vec3 oldStored, vec3 newMean, BlendRule rule) {
    const vec3 newStored = vec3(encodeIrradiance(newMean.x), encodeIrradiance(newMean.y), encodeIrradiance(newMean.z));
    return mix(newStored, oldStored, texelHysteresis(oldStored, newStored, rule));
}

// The same in linear space: unbiased, for averages of a scene that stands still (the mean of fifth roots of noisy
// values is lower than the fifth root of their mean).
KERNEL_FN vec3 blendLinear(vec3 oldStored, vec3 newMean, float hysteresis) {
    const vec3 oldMean =
        vec3(decodeIrradiance(oldStored.x), decodeIrradiance(oldStored.y), decodeIrradiance(oldStored.z));
    const vec3 mean = mix(newMean, oldMean, hysteresis);
    return vec3(encodeIrradiance(mean.x), encodeIrradiance(mean.y), encodeIrradiance(mean.z));
}

KERNELS_END

#endif
