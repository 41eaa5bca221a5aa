// What a ray hits of a union of solids: outside them, where it first enters one; inside, where it leaves them all.
#ifndef PROBEGI_KERNELS_SDF_UNION_HIT_H
#define PROBEGI_KERNELS_SDF_UNION_HIT_H

#include "kernels/sdf/ray_span.h"

KERNELS_BEGIN

// Solids whose surfaces are closer than this along a ray touch, metres: rounding would leave slits between such as were
// meant to share a face.
KERNEL_CONST float kSdfSeam = 1e-5f;

// Values of Hit::geometry: the side of the surface that was hit.
KERNEL_CONST int kSdfFront = 0;
KERNEL_CONST int kSdfFromWithin = 1;

// The best so far of a loop over all solids. Of two at the same distance the first counts.
struct SdfFound {
    float distance;  // metres
    int solid;       // -1: none
};

KERNEL_FN SdfFound sdfFoundNone(float distance) {
    SdfFound found;
    found.distance = distance;
    found.solid = -1;
    return found;
}

// Whether a ray's first point is inside.
KERNEL_FN bool sdfStartsInside(SdfSpan span, float near) {
    return span.entry < near && span.exit > near;
}

// Takes the entry into `solid` if it is at or beyond `near` and nearer. `found` begins with the ray's far end.
KERNEL_FN void sdfEnter(INOUT(SdfFound) found, SdfSpan span, float near, int solid) {
    const bool hit = span.entry >= near && span.entry <= span.exit;
    const bool nearer = span.entry < found.distance || (found.solid < 0 && span.entry <= found.distance);
    if (hit && nearer) {
        found.distance = span.entry;
        found.solid = solid;
    }
}

// Goes on to the far end of `solid` if that contains or touches the way's end so far. Repeated over all solids until
// none goes on, that end is where a ray from inside leaves the union. `found` begins with the ray's near end, and the
// first round takes no seam.
KERNEL_FN bool sdfLeave(INOUT(SdfFound) found, SdfSpan span, float seam, int solid) {
    if (!(span.entry < found.distance + seam && span.exit > found.distance)) return false;
    found.distance = span.exit;
    found.solid = solid;
    return true;
}

KERNELS_END

#endif
