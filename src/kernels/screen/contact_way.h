// Ways over the screen on which contact light looks around a sample (SDFDDGI paper, section 3.5). E's integral over
// slices is exact where they are even around the viewer's direction (GTAO, the paper's reference [8]). Away from the
// picture's middle even ways on the screen are not: what is small and round around a direction there is long on the
// image plane.
#ifndef PROBEGI_KERNELS_CONTACT_WAY_H
#define PROBEGI_KERNELS_CONTACT_WAY_H

#include "kernels/screen/pinhole.h"

KERNELS_BEGIN

KERNEL_CONST int kContactSlices = 2;  // of a sample, each with two sides
KERNEL_CONST int kContactSteps = 8;   // samples of a side
// Pixels that no picture has (PictureDesc), so that steps stay integers where a camera lies on a surface.
KERNEL_CONST float kContactWidest = 32768.0f;

// A slice's direction around the viewer's, unit; in the picture's middle these are pixels across and down.
KERNEL_FN vec2 contactAcross(int slice, float turn) {
    const float angle = (float(slice) + turn) * (kPi / float(kContactSlices));
    return vec2(cos(angle), sin(angle));
}

// A slice's line on the screen.
struct ContactWay {
    vec2 across;   // unit: pixels across and down for each pixel along it
    vec3 tangent;  // the same in the world: unit, perpendicular to the viewer's direction
    float pixels;  // along it for each radian, at the sample
};

// Of the sample that the camera sees in the unit `viewDirection`; `turn` 0..1. Such directions have a part along the
// camera's axis, to which pixelDown is perpendicular, so that the two are never parallel and the cosine is above 0.
KERNEL_FN ContactWay contactWay(PinholeCamera camera, vec3 viewDirection, int slice, float turn) {
    const vec3 right = normalize(camera.pixelRight);
    const vec3 down = normalize(camera.pixelDown);
    const vec3 axis = cross(right, down);
    const vec3 first = normalize(cross(down, viewDirection));
    const vec2 share = contactAcross(slice, turn);
    ContactWay way;
    way.tangent = first * share.x + cross(viewDirection, first) * share.y;
    const float cosine = dot(viewDirection, axis);
    const vec3 inPlane = way.tangent - viewDirection * (dot(way.tangent, axis) / cosine);
    const vec2 onScreen = vec2(dot(inPlane, right), dot(inPlane, down));
    const float stretch = length(onScreen);
    way.across = onScreen / stretch;
    way.pixels = stretch / (cosine * pinholeSpread(camera, 1));
    return way;
}

// Pixels that the reach covers along a way, of a sample at `distance` from the camera, both in metres: as many on both
// sides, which is right for small angles. On the plane across the sample's direction they meet the reach but for a
// share of s / (1 - s), s = reach / distance * tan(the direction's angle with the camera's axis).
KERNEL_FN float contactWidest(IN(ContactWay) way, float distance, float reach) {
    const float metres = reach * way.pixels;
    return metres < kContactWidest * distance ? metres / distance : kContactWidest;
}

// Pixels from a sample to the `step`-th one of a side: densest near it. `widest`: pixels that the reach covers.
KERNEL_FN float contactStep(int step, float phase, float widest) {
    const float share = (float(step) + phase) / float(kContactSteps);
    return max(share * share * widest, float(step + 1));
}

KERNELS_END

#endif
