// Glossy rays of many blocks brought together, by roughness and distance (DDGI paper, section 4.4), within the edges of
// what the samples show. Widths are in blocks of 2 x 2 pixels.
#ifndef PROBEGI_KERNELS_GLOSSY_BLUR_H
#define PROBEGI_KERNELS_GLOSSY_BLUR_H

#include "kernels/language.h"

KERNELS_BEGIN

// Blocks around a ray over which its reach is averaged.
KERNEL_CONST int kGlossyReachTaps = 2;
// The narrow blur reaches so far, and the wide one this many times its step.
KERNEL_CONST int kGlossyTaps = 3;
// Blocks; the widest lobes are cut off there.
KERNEL_CONST float kGlossyWidest = 15.0f;
// Of a lobe's width on the screen: the rays have it already, so that all of it would double the lobe's variance.
KERNEL_CONST float kGlossyBlurShare = 0.75f;

// How far samples around a ray are averaged, in blocks; up to 1: not at all. `reach`: the mean of glossyReach() around
// it, since single rays of a wide lobe go far or not by chance; `pixelAngle`: of a pixel, radians. Half of GGX's light
// leaves within 2 alpha of the mirror direction.
KERNEL_FN float glossyBlurRadius(float roughness, float reach, float pixelAngle) {
    const float lobe = 2.0f * roughness * roughness;
    return min(kGlossyBlurShare * lobe * reach / (2.0f * pixelAngle), kGlossyWidest);
}

// Blocks from tap to tap of the wide blur; 0: it has nothing to do.
KERNEL_FN float glossyStep(float radius) {
    const float reach = float(kGlossyTaps);
    return radius > reach ? radius / reach : 0.0f;
}

// Share of the wide blur in its result: it sets in gently.
KERNEL_FN float glossyWideShare(float radius) {
    return clamp(radius - float(kGlossyTaps), 0.0f, 1.0f);
}

// Blocks from the centre to a tap.
KERNEL_FN int glossyOffset(int tap, float step) {
    return int(floor(float(tap) * step + 0.5f));
}

// Weight by the distance from the centre, both in the same unit.
KERNEL_FN float glossyFalloff(float distance, float radius) {
    const float share = min(distance / max(radius, 1e-6f), 1.0f);
    const float left = 1.0f - share * share;
    return left * left;
}

// What the blur must know of a sample.
struct GlossyGuide {
    vec3 position;
    vec3 geometricNormal;
    vec3 shadingNormal;
    float roughness;
    float distance;  // metres from the viewer
};

KERNEL_CONST float kGlossyRoughnessStep = 0.1f;
KERNEL_CONST float kGlossyLeastTurn = 0.1f;  // radians

// How far a sample may stand for another one, `pixels` away: 0 across edges of depth, normal and roughness. A lobe wide
// as an angle hides turns of that angle.
KERNEL_FN float guideWeight(IN(GlossyGuide) centre, IN(GlossyGuide) tap, float pixels, float pixelAngle) {
    const float covered = 0.5f * (pixels + 1.0f) * pixelAngle * centre.distance;
    const float off = dot(centre.geometricNormal, tap.position - centre.position) / max(covered, 1e-6f);
    const float turn = kGlossyLeastTurn + 2.0f * centre.roughness * centre.roughness;
    const float turned = (1.0f - dot(centre.shadingNormal, tap.shadingNormal)) / (0.5f * turn * turn);
    const float rougher = abs(centre.roughness - tap.roughness) / kGlossyRoughnessStep;
    return max(1.0f - off * off, 0.0f) * max(1.0f - turned, 0.0f) * max(1.0f - rougher, 0.0f);
}

// Weight of a block's ray for a pixel, by the pixels between them: a tent, so that a pixel with a ray of its own shows
// it, and those between interpolate.
KERNEL_FN float glossyTent(float alongX, float alongY) {
    return max(1.0f - 0.5f * abs(alongX), 0.0f) * max(1.0f - 0.5f * abs(alongY), 0.0f);
}

// Least guideWeight() of a ray within the tent: where no ray is of the pixel's own surface, it must not be black.
KERNEL_CONST float kGlossyLeastGuide = 1e-3f;

// A weighted mean as a difference to its first value: what is the same everywhere stays exactly so.
struct GlossyMean {
    vec3 first;
    vec3 sum;
    float weight;
};

KERNEL_FN GlossyMean glossyMean(vec3 first, float weight) {
    GlossyMean mean;
    mean.first = first;
    mean.sum = vec3(0.0f);
    mean.weight = weight;
    return mean;
}

KERNEL_FN void addTap(INOUT(GlossyMean) mean, vec3 radiance, float weight) {
    mean.sum += weight * (radiance - mean.first);
    mean.weight += weight;
}

KERNEL_FN vec3 meanOf(IN(GlossyMean) mean) {
    return mean.weight > 0.0f ? mean.first + mean.sum / mean.weight : mean.first;
}

KERNELS_END

#endif
