// What a picture keeps of each pixel: means over its sub-samples.
#ifndef PROBEGI_KERNELS_PIXEL_LAYERS_H
#define PROBEGI_KERNELS_PIXEL_LAYERS_H

#include "kernels/language.h"

KERNELS_BEGIN

// The layers of probegi::Picture; sums until meanLayers(), when color is the sky's alone.
struct PixelLayers {
    vec3 color;
    vec3 direct;
    vec3 indirect;
    vec3 irradiance;
    vec3 albedo;
    vec3 normal;
    vec3 glossy;
    vec3 contact;
    float depth;
    float openness;
};

KERNEL_FN PixelLayers emptyLayers() {
    PixelLayers layers;
    layers.color = layers.direct = layers.indirect = vec3(0.0f);
    layers.irradiance = layers.albedo = layers.normal = layers.glossy = layers.contact = vec3(0.0f);
    layers.depth = layers.openness = 0.0f;
    return layers;
}

KERNEL_FN void addSky(INOUT(PixelLayers) sums, vec3 radiance) {
    sums.color += radiance;
}

// `direct` is radiance, `irradiance` is the field's E.
KERNEL_FN void addSurface(INOUT(PixelLayers) sums, vec3 direct, vec3 irradiance, vec3 albedo, vec3 normal,
                          float distance) {
    sums.direct += direct;
    sums.indirect += albedo * irradiance * (1.0f / kPi);
    sums.irradiance += irradiance;
    sums.albedo += albedo;
    sums.normal += normal;
    sums.depth += distance;
}

// The same with a glossy lobe, part of `indirect` radiance.
KERNEL_FN void addGlossySurface(INOUT(PixelLayers) sums, vec3 direct, vec3 irradiance, vec3 diffuse, vec3 glossy,
                                vec3 albedo, vec3 normal, float distance) {
    sums.direct += direct;
    sums.indirect += diffuse + glossy;
    sums.glossy += glossy;
    sums.irradiance += irradiance;
    sums.albedo += albedo;
    sums.normal += normal;
    sums.depth += distance;
}

// What contact light found at a surface: E in W m^-2, and the share of E's directions that it takes.
KERNEL_FN void addContactLayers(INOUT(PixelLayers) sums, vec3 irradiance, float taken) {
    sums.contact += irradiance;
    sums.openness += 1.0f - taken;
}

KERNEL_FN PixelLayers meanLayers(IN(PixelLayers) sums, int samples) {
    const float weight = 1.0f / float(samples);
    PixelLayers means;
    means.direct = weight * sums.direct;
    means.indirect = weight * sums.indirect;
    means.color = means.direct + means.indirect + weight * sums.color;
    means.irradiance = weight * sums.irradiance;
    means.albedo = weight * sums.albedo;
    means.normal = weight * sums.normal;
    means.glossy = weight * sums.glossy;
    means.contact = weight * sums.contact;
    means.openness = weight * sums.openness;
    means.depth = weight * sums.depth;
    return means;
}

KERNELS_END

#endif
