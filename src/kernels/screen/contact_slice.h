// Slices of the hemisphere around a sample of the screen, and the horizon in each of them: what rises above it, seen
// from there, and how much of the irradiance comes from the angles it takes (SDFDDGI paper, section 3.5; angles as in
// its reference [8], GTAO).
//
// A slice is a plane through the viewer and the sample, which the screen shows as a line (contact_way.h: slices must be
// even around the viewer's direction). Angles in it are from the direction to the viewer, positive on the side at hand;
// the two sides of a slice have the same text.
#ifndef PROBEGI_KERNELS_CONTACT_SLICE_H
#define PROBEGI_KERNELS_CONTACT_SLICE_H

#include "kernels/language.h"

KERNELS_BEGIN

struct ContactSlice {
    vec3 toViewer;  // unit
    vec3 tangent;   // unit, perpendicular to it, along the screen
    float tilt;     // of the shading normal's part in the slice, towards the tangent
    float ground;   // the same of the geometric normal
    float weight;   // length of the shading normal's part
};

// `along`: the slice's direction (ContactWay::tangent); any length but 0.
KERNEL_FN ContactSlice contactSlice(vec3 toViewer, vec3 along, vec3 shadingNormal, vec3 geometricNormal) {
    ContactSlice slice;
    slice.toViewer = toViewer;
    slice.tangent = normalize(along - toViewer * dot(along, toViewer));
    const vec2 shading = vec2(dot(shadingNormal, slice.tangent), dot(shadingNormal, toViewer));
    slice.weight = length(shading);
    slice.tilt = atan(shading.x, shading.y);
    slice.ground = atan(dot(geometricNormal, slice.tangent), dot(geometricNormal, toViewer));
    return slice;
}

// The integral of |sin a| cos(a - tilt) from the viewer's direction to `angle`: the part of E there, of a radiance of
// 1, for a step of the slices' angle around the viewer's direction, over the slice's weight.
KERNEL_FN float contactArc(float angle, float tilt) {
    return 0.25f * (cos(tilt) - cos(2.0f * angle - tilt) + 2.0f * angle * sin(tilt));
}

// The part of E in all of a slice, both sides: 1 on average over slices.
KERNEL_FN float contactWhole(IN(ContactSlice) slice) {
    return slice.weight * (cos(slice.tilt) + slice.tilt * sin(slice.tilt));
}

// One side of a slice, while its samples are visited.
struct ContactSide {
    float sign;     // of the tangent
    float tilt;     // as in ContactSlice, towards this side
    float ground;   // angle where the sample's own plane begins
    float edge;     // where E's cosine ends
    float horizon;  // highest so far
    float below;    // contactArc() up to it
};

KERNEL_FN ContactSide contactSide(IN(ContactSlice) slice, float sign) {
    ContactSide side;
    side.sign = sign;
    side.tilt = sign * slice.tilt;
    side.ground = sign * slice.ground + 0.5f * kPi;
    side.edge = side.tilt + 0.5f * kPi;
    side.horizon = side.ground;
    side.below = contactArc(max(min(side.ground, side.edge), 0.0f), side.tilt);
    return side;
}

// Sine of the height over a sample's plane up to which another sample counts as part of the plane.
KERNEL_CONST float kContactFlat = 0.02f;

// How far a sample at a distance is contact's and not the probes', 1 to 0.
KERNEL_FN float contactNearness(float distance, float reach) {
    const float share = min(distance / reach, 1.0f);
    const float left = 1.0f - share * share;
    return left * left;
}

// The horizon when the next sample is visited, `offset` metres away: returns the part of E in the angles by which it
// rises, over the slice's weight. What is far raises it part of the way, and so does what is contact's to a `share`
// only.
KERNEL_FN float raiseHorizon(INOUT(ContactSide) side, IN(ContactSlice) slice, vec3 geometricNormal, vec3 offset,
                             float reach, float share) {
    const float distance = length(offset);
    const float along = side.sign * dot(offset, slice.tangent);
    if (distance >= reach || along <= 0.0f || dot(offset, geometricNormal) <= kContactFlat * distance) return 0.0f;
    const float angle = max(atan(along, dot(offset, slice.toViewer)), 0.0f);
    const float raised = side.ground + (angle - side.ground) * (share * contactNearness(distance, reach));
    if (raised >= side.horizon) return 0.0f;
    const float below = contactArc(max(min(raised, side.edge), 0.0f), side.tilt);
    const float arc = max(side.below - below, 0.0f);
    side.horizon = raised;
    side.below = below;
    return arc;
}

KERNELS_END

#endif
