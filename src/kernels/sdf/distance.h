// Signed distances of solids, negative inside, for one point or several abreast. Their Lipschitz constant is 1, on
// which eq. 3 and 4 of SDFDDGI and sphere tracing rest.
#ifndef PROBEGI_KERNELS_SDF_DISTANCE_H
#define PROBEGI_KERNELS_SDF_DISTANCE_H

#include "kernels/lanes.h"
#include "kernels/sdf/sdf_solid.h"
#include "kernels/volume/volume_frame.h"

KERNELS_BEGIN

// Directions of the world in the solid's frame, and back; most boxes stand along the world's axes.
KERNEL_FN Real3 sdfToLocal(SdfSolid solid, Real3 direction) {
    if (solid.rotation.w == 1.0f) return direction;
    return turnedBy(vec3(-solid.rotation.x, -solid.rotation.y, -solid.rotation.z), solid.rotation.w, direction);
}
KERNEL_FN Real3 sdfToWorld(SdfSolid solid, Real3 direction) {
    if (solid.rotation.w == 1.0f) return direction;
    return turnedBy(vec3(solid.rotation.x, solid.rotation.y, solid.rotation.z), solid.rotation.w, direction);
}

// How far a point is beyond each pair of faces of a box, or (negative) inside them.
KERNEL_FN Real3 sdfBeyondFaces(vec3 halfSize, Real3 p) {
    return abs(p) - halfSize;
}

KERNEL_FN Real sdfBoxDistance(vec3 halfSize, Real3 p) {
    const Real3 beyond = sdfBeyondFaces(halfSize, p);
    return length(max(beyond, vec3(0.0f))) + min(max(beyond.x, max(beyond.y, beyond.z)), Real(0.0f));
}

// The point of a capsule's segment that is closest to p.
KERNEL_FN Real3 sdfOnSegment(float halfLength, Real3 p) {
    return Real3(Real(0.0f), min(max(p.y, Real(-halfLength)), Real(halfLength)), Real(0.0f));
}

KERNEL_FN Real sdfFromAxis(Real3 p) {
    return sqrt(p.x * p.x + p.z * p.z);
}

// How far a point is beyond a cylinder's side and its ends.
KERNEL_FN Real2 sdfBeyondCylinder(vec3 halfSize, Real3 p) {
    return Real2(sdfFromAxis(p) - halfSize.x, abs(p.y) - halfSize.y);
}

KERNEL_FN Real sdfCylinderDistance(vec3 halfSize, Real3 p) {
    const Real2 beyond = sdfBeyondCylinder(halfSize, p);
    const Real side = max(beyond.x, Real(0.0f));
    const Real end = max(beyond.y, Real(0.0f));
    return sqrt(side * side + end * end) + min(max(beyond.x, beyond.y), Real(0.0f));
}

// Signed distance from a point in the shape's frame, metres.
KERNEL_FN Real sdfLocalDistance(SdfSolid solid, Real3 p) {
    if (solid.shape <= kSdfRoundedBox) {
        const float rounding = sdfRounding(solid);
        return sdfBoxDistance(solid.halfSize - vec3(rounding), p) - rounding;
    }
    if (solid.shape == kSdfSphere) return length(p) - solid.halfSize.x;
    if (solid.shape == kSdfCapsule) return length(p - sdfOnSegment(solid.halfSize.y, p)) - solid.halfSize.x;
    if (solid.shape == kSdfCylinder) return sdfCylinderDistance(solid.halfSize, p);
    return p.y;
}

KERNELS_END

#endif
