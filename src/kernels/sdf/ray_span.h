// The part of a line that is inside a solid, exactly: all shapes are convex, so there is one part at most. Origins are
// first moved along the line to where it is close to the shape, since distances far larger than the shape would leave
// no digits for the roots of the quadratics.
#ifndef PROBEGI_KERNELS_SDF_RAY_SPAN_H
#define PROBEGI_KERNELS_SDF_RAY_SPAN_H

#include "kernels/sdf/primitive.h"
#include "kernels/trace/bvh_node.h"

KERNELS_BEGIN

// Distances along a ray at which it enters and leaves a solid, negative behind its origin. entry > exit: it misses.
struct SdfSpan {
    float entry;  // metres
    float exit;
};

KERNEL_FN SdfSpan sdfSpan(float entry, float exit) {
    SdfSpan span;
    span.entry = entry;
    span.exit = exit;
    return span;
}

KERNEL_FN SdfSpan sdfNoSpan() {
    return sdfSpan(kSdfFar, -kSdfFar);
}

KERNEL_FN SdfSpan sdfBothSpans(SdfSpan a, SdfSpan b) {
    return sdfSpan(max(a.entry, b.entry), min(a.exit, b.exit));
}

// Of two spans of one convex solid, which overlap if neither is empty.
KERNEL_FN SdfSpan sdfEitherSpan(SdfSpan a, SdfSpan b) {
    if (a.entry > a.exit) return b;
    if (b.entry > b.exit) return a;
    return sdfSpan(min(a.entry, b.entry), max(a.exit, b.exit));
}

// Reciprocals of a direction's components; those that are negligible count as tiny, so none is infinite.
KERNEL_FN vec3 sdfInverse(vec3 direction) {
    const float largest = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
    return vec3(bvhInverse(direction.x, largest), bvhInverse(direction.y, largest), bvhInverse(direction.z, largest));
}

// A box around the frame's origin: for each axis the distance to its middle, plus and minus half a crossing.
KERNEL_FN SdfSpan sdfBoxSpan(vec3 halfSize, vec3 origin, vec3 inverse) {
    const vec3 middle = -origin * inverse;
    const vec3 reach = halfSize * abs(inverse);
    const vec3 entries = middle - reach;
    const vec3 exits = middle + reach;
    return sdfSpan(max(entries.x, max(entries.y, entries.z)), min(exits.x, min(exits.y, exits.z)));
}

// Both roots of a square distance a t^2 + 2 b t + c = 0; `discriminant` = b^2 - a c.
KERNEL_FN SdfSpan sdfRoots(float a, float b, float discriminant) {
    if (discriminant < 0.0f) return sdfNoSpan();
    const float root = sqrt(discriminant);
    return sdfSpan((-b - root) / a, (-b + root) / a);
}

KERNEL_FN SdfSpan sdfSphereSpan(float radius, vec3 origin, vec3 direction) {
    const float along = -dot(origin, direction);
    const vec3 closest = origin + direction * along;
    const float square = radius * radius - dot(closest, closest);
    if (square < 0.0f) return sdfNoSpan();
    const float reach = sqrt(square);
    return sdfSpan(along - reach, along + reach);
}

// Between the planes y = -halfLength and y = halfLength.
KERNEL_FN SdfSpan sdfSlabSpan(float halfLength, vec3 origin, vec3 inverse) {
    const float middle = -origin.y * inverse.y;
    const float reach = halfLength * abs(inverse.y);
    return sdfSpan(middle - reach, middle + reach);
}

// Within a radius of the whole Y axis.
KERNEL_FN SdfSpan sdfTubeSpan(float radius, vec3 origin, vec3 direction) {
    const float a = direction.x * direction.x + direction.z * direction.z;
    const float b = origin.x * direction.x + origin.z * direction.z;
    const float c = origin.x * origin.x + origin.z * origin.z - radius * radius;
    if (a < 1e-14f) return c <= 0.0f ? sdfSpan(-kSdfFar, kSdfFar) : sdfNoSpan();
    // b^2 - a c, with the terms that cancel left out.
    const float side = origin.x * direction.z - origin.z * direction.x;
    return sdfRoots(a, b, a * radius * radius - side * side);
}

KERNEL_FN SdfSpan sdfCylinderSpan(vec3 halfSize, vec3 origin, vec3 direction) {
    return sdfBothSpans(sdfTubeSpan(halfSize.x, origin, direction),
                        sdfSlabSpan(halfSize.y, origin, sdfInverse(direction)));
}

// A capsule is a cylinder and a ball at each end.
KERNEL_FN SdfSpan sdfCapsuleSpan(vec3 halfSize, vec3 origin, vec3 direction) {
    const vec3 end = vec3(0.0f, halfSize.y, 0.0f);
    const SdfSpan ends = sdfEitherSpan(sdfSphereSpan(halfSize.x, origin - end, direction),
                                       sdfSphereSpan(halfSize.x, origin + end, direction));
    return sdfEitherSpan(ends, sdfCylinderSpan(halfSize, origin, direction));
}

// Where a ray from outside enters all that is within `rounding` > 0 of a box around the origin; kSdfFar: nowhere. The
// square distance to the box is a sum of a square per axis, (|p| - halfSize)^2 beyond its faces and 0 between them:
// convex, and quadratic between the six planes of the faces.
KERNEL_FN float sdfRoundedEntry(vec3 halfSize, float rounding, vec3 origin, vec3 direction) {
    const vec3 inverse = sdfInverse(direction);
    const vec3 middle = -origin * inverse;
    const vec3 reach = halfSize * abs(inverse);
    const vec3 first = middle - reach;
    const vec3 last = middle + reach;
    float t = 0.0f;
    for (int piece = 0; piece < 7; ++piece) {
        float next = kSdfFar;
        for (int axis = 0; axis < 3; ++axis) {
            if (first[axis] > t) next = min(next, first[axis]);
            if (last[axis] > t) next = min(next, last[axis]);
        }
        const float within = next < kSdfFar ? 0.5f * (t + next) : t + 1.0f;
        float a = 0.0f;
        float b = 0.0f;
        float c = -rounding * rounding;
        for (int axis = 0; axis < 3; ++axis) {
            if (within > first[axis] && within < last[axis]) continue;
            const float side = signNotZero(origin[axis] + within * direction[axis]);
            const float beyond = side * origin[axis] - halfSize[axis];
            a += direction[axis] * direction[axis];
            b += beyond * side * direction[axis];
            c += beyond * beyond;
        }
        if (a > 0.0f) {
            const SdfSpan roots = sdfRoots(a, b, b * b - a * c);
            if (roots.entry <= roots.exit && roots.entry >= t && roots.entry <= next) return roots.entry;
            // Inside already, but for rounding: pieces meet in the same value.
            if (roots.entry <= t && roots.exit >= t) return t;
        } else if (c <= 0.0f) {
            return t;
        }
        if (next >= kSdfFar) return kSdfFar;
        t = next;
    }
    return kSdfFar;
}

// `halfSize` includes the rounding, > 0. The exit is the entry of the ray that comes from the other side.
KERNEL_FN SdfSpan sdfRoundedSpan(vec3 halfSize, float rounding, vec3 origin, vec3 direction) {
    const SdfSpan outer = sdfBoxSpan(halfSize, origin, sdfInverse(direction));
    if (outer.entry > outer.exit) return sdfNoSpan();
    const vec3 core = halfSize - vec3(rounding);
    const float entry = sdfRoundedEntry(core, rounding, origin + direction * outer.entry, direction);
    const float exit = sdfRoundedEntry(core, rounding, origin + direction * outer.exit, -direction);
    if (entry >= kSdfFar || exit >= kSdfFar) return sdfNoSpan();
    return sdfSpan(outer.entry + entry, outer.exit - exit);
}

// All below the plane y = 0.
KERNEL_FN SdfSpan sdfPlaneSpan(vec3 origin, vec3 direction) {
    if (abs(direction.y) < 1e-18f) return origin.y <= 0.0f ? sdfSpan(-kSdfFar, kSdfFar) : sdfNoSpan();
    const float crossing = -origin.y / direction.y;
    return direction.y > 0.0f ? sdfSpan(-kSdfFar, crossing) : sdfSpan(crossing, kSdfFar);
}

// `direction` is unit.
KERNEL_FN SdfSpan sdfRaySpan(SdfSolid solid, vec3 rayOrigin, vec3 rayDirection) {
    const vec3 origin = sdfToLocal(solid, rayOrigin - solid.centre);
    const vec3 direction = sdfToLocal(solid, rayDirection);
    if (solid.shape == kSdfPlane) return sdfPlaneSpan(origin, direction);
    if (solid.shape <= kSdfRoundedBox && sdfRounding(solid) <= 0.0f) {
        return sdfBoxSpan(solid.halfSize, origin, sdfInverse(direction));
    }
    const float nearest = -dot(origin, direction);
    const vec3 close = origin + direction * nearest;
    SdfSpan span = sdfNoSpan();
    if (solid.shape == kSdfSphere) span = sdfSphereSpan(solid.halfSize.x, close, direction);
    if (solid.shape == kSdfRoundedBox) span = sdfRoundedSpan(solid.halfSize, solid.rounding, close, direction);
    if (solid.shape == kSdfCapsule) span = sdfCapsuleSpan(solid.halfSize, close, direction);
    if (solid.shape == kSdfCylinder) span = sdfCylinderSpan(solid.halfSize, close, direction);
    return sdfSpan(span.entry + nearest, span.exit + nearest);
}

KERNELS_END

#endif
