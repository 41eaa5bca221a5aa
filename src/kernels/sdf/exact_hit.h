// A ray's hit of all solids by exact intersection, one after the other. Whoever includes this defines before:
//     SdfSolid sdfSolid(int number);
#ifndef PROBEGI_KERNELS_SDF_EXACT_HIT_H
#define PROBEGI_KERNELS_SDF_EXACT_HIT_H

#include "kernels/sdf/union_hit.h"

KERNELS_BEGIN

// What a ray that begins inside hits: where it leaves the union. `solid` -1: it begins outside.
KERNEL_FN SdfFound sdfWayOut(vec3 origin, float near, vec3 direction, int solids) {
    SdfFound found = sdfFoundNone(near);
    float seam = 0.0f;
    bool on = true;
    while (on) {
        on = false;
        for (int i = 0; i < solids; ++i) {
            const bool further = sdfLeave(found, sdfRaySpan(sdfSolid(i), origin, direction), seam, i);
            on = further || on;
        }
        seam = kSdfSeam;
    }
    return found;
}

// What the ray hits of the union between near and far; `solid` -1: nothing. `within`: from inside.
KERNEL_FN SdfFound sdfClosestHit(vec3 origin, float near, vec3 direction, float far, int solids, OUT(bool) within) {
    within = false;
    if (!bvhRayIsValid(origin, near, direction, far)) return sdfFoundNone(kSdfFar);
    SdfFound found = sdfFoundNone(min(far, kSdfFar));
    for (int i = 0; i < solids; ++i) {
        const SdfSpan span = sdfRaySpan(sdfSolid(i), origin, direction);
        sdfEnter(found, span, near, i);
        within = within || sdfStartsInside(span, near);
    }
    if (!within) return found;
    found = sdfWayOut(origin, near, direction, solids);
    if (found.distance > far || found.distance >= kSdfFar) found.solid = -1;
    return found;
}

// Whether the ray enters a solid, or begins inside and leaves them all, between near and far.
KERNEL_FN bool sdfIsBlocked(vec3 origin, float near, vec3 direction, float far, int solids) {
    if (!bvhRayIsValid(origin, near, direction, far)) return false;
    bool within = false;
    for (int i = 0; i < solids; ++i) {
        const SdfSpan span = sdfRaySpan(sdfSolid(i), origin, direction);
        if (span.entry >= near && span.entry <= span.exit && span.entry <= far) return true;
        within = within || sdfStartsInside(span, near);
    }
    if (!within) return false;
    const float leaves = sdfWayOut(origin, near, direction, solids).distance;
    return leaves <= far && leaves < kSdfFar;
}

KERNELS_END

#endif
