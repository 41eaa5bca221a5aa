// Contact light of many samples brought together, within the edges of what they show; light and shadow in one vec4
// (SDFDDGI paper, section 3.5).
#ifndef PROBEGI_KERNELS_CONTACT_BLUR_H
#define PROBEGI_KERNELS_CONTACT_BLUR_H

#include "kernels/screen/glossy_blur.h"

KERNELS_BEGIN

// Pixels on each side. With contactTap() all of the 4 x 4 pixels that share a pattern have the same weight.
KERNEL_CONST int kContactTaps = 2;

// Weight of a neighbour, by the pixels to it.
KERNEL_FN float contactTap(int along, int down) {
    return (abs(along) < kContactTaps ? 2.0f : 1.0f) * (abs(down) < kContactTaps ? 2.0f : 1.0f);
}

// What guideWeight() must know of a sample: diffuse light turns slowly with the normal.
KERNEL_FN GlossyGuide contactGuide(vec3 position, vec3 geometricNormal, float distance) {
    GlossyGuide guide;
    guide.position = position;
    guide.geometricNormal = geometricNormal;
    guide.shadingNormal = geometricNormal;
    guide.roughness = 0.5f;
    guide.distance = distance;
    return guide;
}

// As GlossyMean, of four values.
struct ContactMean {
    vec4 first;
    vec4 sum;
    float weight;
};

KERNEL_FN ContactMean contactMean(vec4 first, float weight) {
    ContactMean mean;
    mean.first = first;
    mean.sum = vec4(0.0f);
    mean.weight = weight;
    return mean;
}

KERNEL_FN void addContactTap(INOUT(ContactMean) mean, vec4 light, float weight) {
    mean.sum += weight * (light - mean.first);
    mean.weight += weight;
}

KERNEL_FN vec4 contactMeanOf(IN(ContactMean) mean) {
    return mean.first + mean.sum * (1.0f / mean.weight);
}

// E with what contact light adds to it or takes from it.
KERNEL_FN vec3 withContact(vec3 irradiance, vec4 contact) {
    return max(irradiance + vec3(contact.x, contact.y, contact.z), vec3(0.0f));
}

KERNELS_END

#endif
