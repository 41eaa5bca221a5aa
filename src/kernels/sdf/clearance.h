// How far a segment passes by a solid: soft shadows of SDFDDGI, section 3.4, in closed form where sphere tracing takes
// steps. For one segment or several abreast.
//
// The clearance of a segment from a point to a probe is the radius, in metres, of the largest ball around the probe
// that the point sees past the solid in full: the least of distance(t) / t on the way, t running from 0 at the point to
// 1 at the probe. It is positive if and only if the segment, which begins outside, meets the solid nowhere.
#ifndef PROBEGI_KERNELS_SDF_CLEARANCE_H
#define PROBEGI_KERNELS_SDF_CLEARANCE_H

#include "kernels/sdf/distance.h"

KERNELS_BEGIN

// Steps of the search for the least of distance(t) / t of shapes without a closed form.
KERNEL_CONST int kClearanceSteps = 14;
// Where that search begins, share of the way.
KERNEL_CONST float kClearanceBegin = 0.01f;

// Of the lines by which an axis i may keep a box at a distance (`rise` at the way's beginning and `gain` more at its
// end, metres) and another axis j still has the way between its faces (for `until` metres of its `along`), over the
// way's share: their height where they cross.
KERNEL_FN Real crossing(Real gain, Real rise, Real along, Real until) {
    return (gain * until + along * rise) / (rise + until + 1e-20f);
}

// Of a box around the origin, by the largest of the three distances from its pairs of faces. Beyond edges and corners
// that is less than the Euclidean distance, so that the ball is never too large: of ways that are partly free the
// Euclidean one is 1.19 times as large in the median, at most 1.75 times. Each of the three grows or falls in
// proportion to t, and over t to 1 / t, so the least of the largest lies where a line that falls crosses one that
// rises, or at the way's end.
KERNEL_FN Real sdfBoxClearance(vec3 halfSize, Real3 from, Real3 way) {
    const Real3 along = abs(way);
    const Real3 ahead = Real3(from.x * signNotZero(way.x), from.y * signNotZero(way.y), from.z * signNotZero(way.z));
    const Real3 past = ahead - halfSize;  // the faces by which the way leaves
    const Real3 until = max(Real3(vec3(0.0f)) - past, vec3(0.0f));
    const Real3 before = Real3(-halfSize) - ahead;  // the faces by which it enters
    const Real3 rise = Real3(max(max(past.x, before.x), Real(0.0f)), max(max(past.y, before.y), Real(0.0f)),
                             max(max(past.z, before.z), Real(0.0f)));
    const Real3 gain = Real3(select(past.x < 0.0f, Real(0.0f) - along.x, along.x),
                             select(past.y < 0.0f, Real(0.0f) - along.y, along.y),
                             select(past.z < 0.0f, Real(0.0f) - along.z, along.z));
    Real clearance = max(gain.x + rise.x, max(gain.y + rise.y, gain.z + rise.z));
    clearance =
        max(clearance, max(crossing(gain.x, rise.x, along.y, until.y), crossing(gain.x, rise.x, along.z, until.z)));
    clearance =
        max(clearance, max(crossing(gain.y, rise.y, along.x, until.x), crossing(gain.y, rise.y, along.z, until.z)));
    return max(clearance, max(crossing(gain.z, rise.z, along.x, until.x), crossing(gain.z, rise.z, along.y, until.y)));
}

KERNEL_FN Real3 scaledBy(Real3 v, Real factor) {
    return Real3(v.x * factor, v.y * factor, v.z * factor);
}

KERNEL_FN Real distanceOverShare(SdfSolid solid, Real3 from, Real3 way, Real share) {
    return sdfLocalDistance(solid, from + scaledBy(way, share)) / share;
}

// Of any shape, by golden section: the distance to a convex solid over t has one valley.
KERNEL_FN Real sdfSearchedClearance(SdfSolid solid, Real3 from, Real3 way) {
    const float golden = 0.618034f;
    Real low = Real(kClearanceBegin);
    Real high = Real(1.0f);
    Real left = high - (high - low) * golden;
    Real right = low + (high - low) * golden;
    Real atLeft = distanceOverShare(solid, from, way, left);
    Real atRight = distanceOverShare(solid, from, way, right);
    Real least = min(distanceOverShare(solid, from, way, low), distanceOverShare(solid, from, way, high));
    for (int i = 0; i < kClearanceSteps; ++i) {
        const Bool falls = atRight < atLeft;  // the valley lies to the right of `left`
        low = select(falls, left, low);
        high = select(falls, high, right);
        const Real known = select(falls, right, left);
        const Real atKnown = select(falls, atRight, atLeft);
        const Real next = select(falls, low + (high - low) * golden, high - (high - low) * golden);
        const Real atNext = distanceOverShare(solid, from, way, next);
        left = select(falls, known, next);
        atLeft = select(falls, atKnown, atNext);
        right = select(falls, next, known);
        atRight = select(falls, atNext, atKnown);
        least = min(least, atNext);
    }
    return min(least, min(atLeft, atRight));
}

// `from` and `way`: in the solid's frame, metres.
KERNEL_FN Real sdfClearance(SdfSolid solid, Real3 from, Real3 way) {
    if (solid.shape == kSdfBox) return sdfBoxClearance(solid.halfSize, from, way);
    return sdfSearchedClearance(solid, from, way);
}

// How far the way's end is from the solid: what its clearance is where nothing is in between.
KERNEL_FN Real sdfEndClearance(SdfSolid solid, Real3 end) {
    if (solid.shape != kSdfBox) return sdfLocalDistance(solid, end);
    const Real3 beyond = sdfBeyondFaces(solid.halfSize, end);
    return max(beyond.x, max(beyond.y, beyond.z));
}

// Whether a box of the world, by its middle and half its extents, may meet the solid.
KERNEL_FN Bool sdfIsNear(IN(SdfBlocker) blocker, Real3 middle, Real3 extent) {
    const Real3 apart = abs(middle - blocker.solid.centre) - extent;
    return apart.x < blocker.reach.x && apart.y < blocker.reach.y && apart.z < blocker.reach.z;
}

KERNELS_END

#endif
