// Punctual lights: the directional, point and spot lights of KHR_lights_punctual.
#ifndef PROBEGI_KERNELS_PUNCTUAL_LIGHT_H
#define PROBEGI_KERNELS_PUNCTUAL_LIGHT_H

#include "kernels/screen/colour.h"

KERNELS_BEGIN

// In the order of probegi::LightType.
KERNEL_CONST int kLightDirectional = 0;
KERNEL_CONST int kLightPoint = 1;
KERNEL_CONST int kLightSpot = 2;

// Distance of a light at infinity: larger than any scene, less than Ray::far.
KERNEL_CONST float kLightAtInfinity = 1e29f;

struct LightSample {
    vec3 toLight;             // unit, from the point to the light
    float distance;           // metres; kLightAtInfinity for a directional light
    vec3 irradianceAtNormal;  // W m^-2 at normal incidence
};

// Extension text, "Range Property": attenuation = max(min(1 - (distance / range)^4, 1), 0) / distance^2; the window
// is 1 where range is 0 (unlimited).
KERNEL_FN float punctualRangeWindow(float distance, float range) {
    if (range <= 0.0f) return 1.0f;
    const float q = distance / range;
    const float q2 = q * q;
    return clamp(1.0f - q2 * q2, 0.0f, 1.0f);
}

// Extension text, "Inner and Outer Cone Angles": the square of a linear ramp in the cosine between the two cones.
// `cosAngle` is the cosine between the spot's axis and the direction from the light to the point.
KERNEL_FN float punctualConeFactor(float cosAngle, float cosInner, float cosOuter) {
    const float scale = 1.0f / max(0.001f, cosInner - cosOuter);
    const float ramp = clamp((cosAngle - cosOuter) * scale, 0.0f, 1.0f);
    return ramp * ramp;
}

// Unshadowed light at a point. `lightDir` is unit, the direction in which the light travels. A point at the light's own
// position receives nothing, since the inverse square is undefined there.
KERNEL_FN LightSample samplePunctual(int type, vec3 lightPos, vec3 lightDir, vec3 intensity, float range,
                                     float cosInner, float cosOuter, vec3 point) {
    LightSample result;
    if (type == kLightDirectional) {
        result.toLight = vec3(0.0f) - lightDir;
        result.distance = kLightAtInfinity;
        result.irradianceAtNormal = intensity;
        return result;
    }
    const vec3 offset = lightPos - point;
    const float squared = dot(offset, offset);
    if (!(squared > 1e-30f)) {
        result.toLight = vec3(0.0f, 1.0f, 0.0f);
        result.distance = 0.0f;
        result.irradianceAtNormal = vec3(0.0f);
        return result;
    }
    result.distance = sqrt(squared);
    result.toLight = offset / result.distance;
    float factor = punctualRangeWindow(result.distance, range) / squared;
    if (type == kLightSpot) factor *= punctualConeFactor(0.0f - dot(result.toLight, lightDir), cosInner, cosOuter);
    result.irradianceAtNormal = intensity * factor;
    return result;
}

// Whether a surface point gets the light if nothing is between them. A light behind either normal does not count: the
// geometric one keeps light from seeping through a surface whose shading normal leans over its edge. Nor does one whose
// channels are all not numbers.
KERNEL_FN bool reachesSurface(LightSample light, vec3 geometricNormal, vec3 shadingNormal) {
    return anyPositive(light.irradianceAtNormal) && dot(light.toLight, shadingNormal) > 0.0f &&
           dot(light.toLight, geometricNormal) > 0.0f;
}

KERNELS_END

#endif
