// Points on the surfaces of a mesh may lie inside the primitives that stand for it, or behind thin ones, by as much as
// those differ from it: where such a point is in front of them. For one point or several abreast.
#ifndef PROBEGI_KERNELS_SDF_WAY_OUT_H
#define PROBEGI_KERNELS_SDF_WAY_OUT_H

#include "kernels/sdf/clearance.h"

KERNELS_BEGIN

// Cosine between a surface's normal and that of a primitive's face below which the face is on the other side of the
// wall: no way out leads there.
KERNEL_CONST float kOtherSide = -0.3f;

// The nearer way out along one axis of those two that stay on the surface's side, with its sign; kSdfFar: none.
KERNEL_FN Real axisWayOut(float halfSize, Real at, Real normal) {
    const Real up = select(normal > kOtherSide, halfSize - at, Real(kSdfFar));
    const Real down = select(normal < -kOtherSide, halfSize + at, Real(kSdfFar));
    return select(up < down, up, Real(0.0f) - down);
}

// From a point inside a box around the origin to the outside, metres; 0 from elsewhere.
KERNEL_FN Real3 sdfBoxWayOut(vec3 halfSize, Real3 p, Real3 normal, float beyond) {
    const Real3 past = sdfBeyondFaces(halfSize, p);
    const Bool inside = max(past.x, max(past.y, past.z)) < 0.0f;
    const Real x = axisWayOut(halfSize.x, p.x, normal.x);
    const Real y = axisWayOut(halfSize.y, p.y, normal.y);
    const Real z = axisWayOut(halfSize.z, p.z, normal.z);
    const Real least = min(abs(x), min(abs(y), abs(z)));
    const Real leaves = select(inside && least < kSdfFar, Real(1.0f) + beyond / max(least, Real(1e-20f)), Real(0.0f));
    // Along one axis: the first of those that are alike.
    const Real none = Real(0.0f);
    return scaledBy(
        Real3(select(least < abs(x), none, x), select(least < abs(x), select(least < abs(y), none, y), none),
              select(least < abs(x), select(least < abs(y), z, none), none)),
        leaves);
}

// The same of any shape, along the gradient of its distance; `beyond` > 0, which is the measure of the steps by which
// that is found.
KERNEL_FN Real3 sdfSearchedWayOut(SdfSolid solid, Real3 p, Real3 normal, float beyond) {
    const float step = 0.05f * beyond;
    const Real distance = sdfLocalDistance(solid, p);
    const Real3 rise = Real3(sdfLocalDistance(solid, p + Real3(vec3(step, 0.0f, 0.0f))) - distance,
                             sdfLocalDistance(solid, p + Real3(vec3(0.0f, step, 0.0f))) - distance,
                             sdfLocalDistance(solid, p + Real3(vec3(0.0f, 0.0f, step))) - distance);
    const Real3 outward = rise / (length(rise) + 1e-20f);
    const Bool leads = distance < 0.0f && dot(outward, normal) > kOtherSide;
    return scaledBy(outward, select(leads, Real(beyond) - distance, Real(0.0f)));
}

KERNEL_FN Real awayFromZero(Real x) {
    return signNotZero(x) * max(abs(x), Real(1e-6f));
}

// Through a box that is thin and close in front of a point, all of it within `reach` metres along its normal: the folds
// of a curtain lie before and behind the one box that stands for it. 0: there is no such box, or the point is inside.
KERNEL_FN Real sdfBoxThrough(vec3 halfSize, Real3 p, Real3 normal, float reach) {
    const Real3 slow = Real3(Real(1.0f) / awayFromZero(normal.x), Real(1.0f) / awayFromZero(normal.y),
                             Real(1.0f) / awayFromZero(normal.z));
    const Real3 reaches = abs(slow) * halfSize;
    const Real3 middle = Real3(Real(0.0f) - p.x * slow.x, Real(0.0f) - p.y * slow.y, Real(0.0f) - p.z * slow.z);
    const Real3 enters = middle - reaches;
    const Real3 leaves = middle + reaches;
    const Real entry = max(enters.x, max(enters.y, enters.z));
    const Real exit = min(leaves.x, min(leaves.y, leaves.z));
    return select(Real(0.0f) < entry && entry < exit && exit < reach, exit, Real(0.0f));
}

// `p` and `normal` in the solid's frame; the way out ends `beyond` metres from its surface.
KERNEL_FN Real3 sdfWayOutOf(SdfSolid solid, Real3 p, Real3 normal, float beyond, float reach) {
    if (solid.shape != kSdfBox) return sdfSearchedWayOut(solid, p, normal, beyond);
    const Real through = sdfBoxThrough(solid.halfSize, p, normal, reach);
    const Real on = select(Real(0.0f) < through, through + beyond, Real(0.0f));
    return sdfBoxWayOut(solid.halfSize, p, normal, beyond) + scaledBy(normal, on);
}

KERNELS_END

#endif
