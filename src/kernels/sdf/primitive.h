// Primitives of a scene (SDFDDGI, section 3.1): distance in the world, gradient, normal, looks.
#ifndef PROBEGI_KERNELS_SDF_PRIMITIVE_H
#define PROBEGI_KERNELS_SDF_PRIMITIVE_H

#include "kernels/sdf/distance.h"
#include "kernels/shade/surface.h"

KERNELS_BEGIN

// What a primitive looks like.
struct SdfPaint {
    vec3 albedo;    // linear RGB, 0..1
    vec3 emission;  // W sr^-1 m^-2
    int faces;      // number of the first texel of its faces (face_texels.h); -1: none
};

// Signed distance from a point in the world, metres.
KERNEL_FN float sdfDistance(SdfSolid solid, vec3 point) {
    return sdfLocalDistance(solid, sdfToLocal(solid, point - solid.centre));
}

// Outward normal of the face that a point is nearest to or farthest beyond.
KERNEL_FN vec3 sdfFaceNormal(vec3 beyond, vec3 p) {
    if (beyond.x >= max(beyond.y, beyond.z)) return vec3(signNotZero(p.x), 0.0f, 0.0f);
    if (beyond.y >= beyond.z) return vec3(0.0f, signNotZero(p.y), 0.0f);
    return vec3(0.0f, 0.0f, signNotZero(p.z));
}

KERNEL_FN vec3 sdfBoxGradient(vec3 halfSize, vec3 p) {
    const vec3 beyond = sdfBeyondFaces(halfSize, p);
    if (max(beyond.x, max(beyond.y, beyond.z)) <= 0.0f) return sdfFaceNormal(beyond, p);
    const vec3 side = vec3(signNotZero(p.x), signNotZero(p.y), signNotZero(p.z));
    return unitOr(max(beyond, vec3(0.0f)) * side, sdfFaceNormal(beyond, p));
}

// Outward normal of a cylinder's side, and that of the end that is nearer.
KERNEL_FN vec3 sdfSideNormal(vec3 p) {
    const float radius = sdfFromAxis(p);
    return radius > 1e-15f ? vec3(p.x / radius, 0.0f, p.z / radius) : vec3(1.0f, 0.0f, 0.0f);
}
KERNEL_FN vec3 sdfEndNormal(vec3 p) {
    return vec3(0.0f, signNotZero(p.y), 0.0f);
}

KERNEL_FN vec3 sdfCylinderGradient(vec3 halfSize, vec3 p) {
    const vec2 beyond = sdfBeyondCylinder(halfSize, p);
    if (max(beyond.x, beyond.y) <= 0.0f) return beyond.x >= beyond.y ? sdfSideNormal(p) : sdfEndNormal(p);
    return unitOr(sdfSideNormal(p) * max(beyond.x, 0.0f) + sdfEndNormal(p) * max(beyond.y, 0.0f), sdfEndNormal(p));
}

// Gradient of the distance in the shape's frame, unit; one of several where it is not unique (centres, axes).
KERNEL_FN vec3 sdfLocalGradient(SdfSolid solid, vec3 p) {
    if (solid.shape <= kSdfRoundedBox) return sdfBoxGradient(solid.halfSize - vec3(sdfRounding(solid)), p);
    if (solid.shape == kSdfSphere) return unitOr(p, vec3(0.0f, 1.0f, 0.0f));
    if (solid.shape == kSdfCapsule) return unitOr(p - sdfOnSegment(solid.halfSize.y, p), vec3(1.0f, 0.0f, 0.0f));
    if (solid.shape == kSdfCylinder) return sdfCylinderGradient(solid.halfSize, p);
    return vec3(0.0f, 1.0f, 0.0f);
}

// Gradient of the distance in the world, unit.
KERNEL_FN vec3 sdfGradient(SdfSolid solid, vec3 point) {
    return sdfToWorld(solid, sdfLocalGradient(solid, sdfToLocal(solid, point - solid.centre)));
}

// Outward normal at a point that is on the surface but for rounding. Where the gradient of a point just beyond a sharp
// edge is oblique, this is the normal of one of the edge's two faces.
KERNEL_FN vec3 sdfSurfaceNormal(SdfSolid solid, vec3 point) {
    const vec3 p = sdfToLocal(solid, point - solid.centre);
    if (solid.shape <= kSdfRoundedBox && sdfRounding(solid) <= 0.0f) {
        return sdfToWorld(solid, sdfFaceNormal(sdfBeyondFaces(solid.halfSize, p), p));
    }
    if (solid.shape == kSdfCylinder) {
        const vec2 beyond = sdfBeyondCylinder(solid.halfSize, p);
        return sdfToWorld(solid, beyond.x >= beyond.y ? sdfSideNormal(p) : sdfEndNormal(p));
    }
    return sdfToWorld(solid, sdfLocalGradient(solid, p));
}

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(SdfPaint, emission) == 12 && sizeof(SdfPaint) == 28);
}  // namespace probegi::kernels
#endif

#endif
