// Glossy reflections: one ray for 2 x 2 pixels, and the light that it brings (DDGI paper, section 4.4).
#ifndef PROBEGI_KERNELS_GLOSSY_RAY_H
#define PROBEGI_KERNELS_GLOSSY_RAY_H

#include "kernels/shade/environment_brdf.h"

KERNELS_BEGIN

// One block of 2 x 2 samples.
struct GlossySample {
    vec3 radiance;  // of the ray, W sr^-1 m^-2; between passes of the blur: blurred twice
    float reach;    // glossyReach() of the ray
    vec3 blurred;   // once
    float radius;   // of the blur: glossyBlurRadius()
    int pixel;      // whose ray it is, row-major in the frame; -1: none of the block needs one
};

// Up to the first roughness all comes from rays; from the second on from the field alone, whose cosine lobe is about
// as wide as theirs.
KERNEL_CONST float kGlossyRayRoughness = 0.6f;
KERNEL_CONST float kGlossyFieldRoughness = 0.75f;

// Share of the rays in the glossy light of a surface, 0..1.
KERNEL_FN float glossyRayShare(float roughness) {
    return clamp((kGlossyFieldRoughness - roughness) / (kGlossyFieldRoughness - kGlossyRayRoughness), 0.0f, 1.0f);
}

// Sides of the half-resolution grid.
KERNEL_FN int glossyBlocks(int pixels) {
    return (pixels + 1) / 2;
}

// The `attempt`-th pixel of a block to try, 0..3, as 2 y + x: each plane of samples begins with another one, so that
// with four of them all pixels have rays of their own.
KERNEL_FN int glossyCandidate(int plane, int attempt) {
    const int order = (plane + attempt) & 3;
    // Diagonally opposite ones follow each other.
    return order == 0 ? 0 : (order == 1 ? 3 : (order == 2 ? 1 : 2));
}

// A bit of both coordinates in Bayer's order: diagonal neighbours follow each other.
KERNEL_FN int glossyBayer(int x, int y, int bit) {
    const int along = (x >> bit) & 1;
    const int down = (y >> bit) & 1;
    return 2 * (along ^ down) + down;
}

// Random numbers of a block: 8 x 8 blocks share 64 points of a sequence of low discrepancy (multiples of the powers of
// the plastic number's inverse), in an order by which small groups are evenly spread too; planes go on in it.
KERNEL_FN vec2 glossyPattern(int x, int y, int plane) {
    const int order = 16 * glossyBayer(x, y, 0) + 4 * glossyBayer(x, y, 1) + glossyBayer(x, y, 2) + 64 * plane;
    return fract(vec2(0.5f) + float(order) * vec2(0.7548776662f, 0.5698402910f));
}

// How much of a turn of the ray is seen on the screen, 0..1: the image lies as far behind the surface as the ray went
// before it. From afar, or next to what it shows, a lobe is narrow; reflecting the sky, it is as wide as it is. Metres.
KERNEL_FN float glossyReach(float rayDistance, float viewDistance) {
    return rayDistance / max(rayDistance + viewDistance, 1e-6f);
}

// A direction that leaves the surface: one from below is mirrored at it.
KERNEL_FN vec3 aboveSurface(vec3 direction, vec3 geometricNormal) {
    const float height = dot(direction, geometricNormal);
    return height >= 0.0f ? direction : direction - geometricNormal * (2.0f * height);
}

// The direction of a mirror image.
KERNEL_FN vec3 mirrorDirection(vec3 shadingNormal, vec3 geometricNormal, vec3 viewDirection) {
    return aboveSurface(reflect(viewDirection, shadingNormal), geometricNormal);
}

// Of a ray: by the density of the visible normals; that of a mirror has no spread.
KERNEL_FN vec3 glossyDirection(vec3 shadingNormal, vec3 geometricNormal, vec3 viewDirection, float roughness, vec2 u) {
    const float alpha = roughness * roughness;
    if (alpha <= kMinAlpha) return mirrorDirection(shadingNormal, geometricNormal, viewDirection);
    const mat3 frame = orthonormalBasis(shadingNormal);
    const vec3 wo = toLocal(frame, -viewDirection);
    const vec3 h = sampleGgxNormal(wo, alpha, u);
    return aboveSurface(toWorld(frame, h * (2.0f * dot(wo, h)) - wo), geometricNormal);
}

// Radiance that a cosine-weighted mean of radiance, as the field has it, stands for: E over the integral of the
// weights. (The paper's "factor of 2 pi" between the two is pi: a uniform L has E = pi L.)
KERNEL_FN vec3 radianceOfIrradiance(vec3 irradiance) {
    return irradiance * (1.0f / kPi);
}

// What the diffuse lobe sends of E around the normal. `cosO` as in lobeAlbedo().
KERNEL_FN vec3 diffuseRadiance(Bsdf b, float cosO, vec3 irradiance) {
    return lobeAlbedo(b, cosO).diffuse * irradiance * (1.0f / kPi);
}

// What the glossy lobe sends, `mean` being the radiance around it.
KERNEL_FN vec3 glossyRadiance(Bsdf b, float cosO, vec3 mean) {
    return lobeAlbedo(b, cosO).specular * mean;
}

// Radiance that a ray brings from what it hit: `direct` as in ScreenSample, `mirrored` the radiance around the hit's
// own mirror direction. Of the sky and of backfaces, which have neither material nor irradiance, `direct` is all.
KERNEL_FN vec3 hitRadiance(Bsdf b, float cosO, vec3 direct, vec3 irradiance, vec3 mirrored) {
    const LobeAlbedo albedo = lobeAlbedo(b, cosO);
    return direct + albedo.diffuse * irradiance * (1.0f / kPi) + albedo.specular * mirrored;
}

KERNELS_END

#endif
