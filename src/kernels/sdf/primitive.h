// Solids with an exact Euclidean distance (SDFDDGI, section 3.1): signed distance and its gradient. The distance is
// negative inside; its Lipschitz constant is 1, on which eq. 3 and 4 and sphere tracing rest.
#ifndef PROBEGI_KERNELS_SDF_PRIMITIVE_H
#define PROBEGI_KERNELS_SDF_PRIMITIVE_H

#include "kernels/shade/surface.h"
#include "kernels/volume/volume_frame.h"

KERNELS_BEGIN

// Values of probegi::SdfShape.
KERNEL_CONST uint kSdfBox = 0u;
KERNEL_CONST uint kSdfRoundedBox = 1u;
KERNEL_CONST uint kSdfSphere = 2u;
KERNEL_CONST uint kSdfCapsule = 3u;
KERNEL_CONST uint kSdfCylinder = 4u;
KERNEL_CONST uint kSdfPlane = 5u;

// Distance to no solid at all, metres.
KERNEL_CONST float kSdfFar = 1e30f;

// Geometry of a primitive, in the world. Each shape is around the origin of a frame of its own.
struct SdfSolid {
    vec3 centre;    // metres
    uint shape;     // kSdfBox ...
    vec4 rotation;  // unit quaternion (x, y, z, w) from the shape's frame to the world
    vec3 halfSize;  // metres, > 0: as probegi::SdfPrimitive::halfSize
    float rounding;
};

// What a primitive looks like.
struct SdfPaint {
    vec3 albedo;    // linear RGB, 0..1
    vec3 emission;  // W sr^-1 m^-2
    int faces;      // number of the first texel of its faces (face_texels.h); -1: none
};

KERNEL_FN vec3 sdfToLocal(SdfSolid solid, vec3 direction) {
    return turnedBy(vec3(-solid.rotation.x, -solid.rotation.y, -solid.rotation.z), solid.rotation.w, direction);
}
KERNEL_FN vec3 sdfToWorld(SdfSolid solid, vec3 direction) {
    return turnedBy(vec3(solid.rotation.x, solid.rotation.y, solid.rotation.z), solid.rotation.w, direction);
}

// Radius of a box's edges.
KERNEL_FN float sdfRounding(SdfSolid solid) {
    return solid.shape == kSdfRoundedBox ? solid.rounding : 0.0f;
}

// How far a point is beyond each pair of faces of a box, or (negative) inside them.
KERNEL_FN vec3 sdfBeyondFaces(vec3 halfSize, vec3 p) {
    return abs(p) - halfSize;
}

KERNEL_FN float sdfBoxDistance(vec3 halfSize, vec3 p) {
    const vec3 beyond = sdfBeyondFaces(halfSize, p);
    return length(max(beyond, vec3(0.0f))) + min(max(beyond.x, max(beyond.y, beyond.z)), 0.0f);
}

// The point of a capsule's segment that is closest to p.
KERNEL_FN vec3 sdfOnSegment(float halfLength, vec3 p) {
    return vec3(0.0f, clamp(p.y, -halfLength, halfLength), 0.0f);
}

// How far a point is beyond a cylinder's side and its ends.
KERNEL_FN vec2 sdfBeyondCylinder(vec3 halfSize, vec3 p) {
    return vec2(length(vec2(p.x, p.z)) - halfSize.x, abs(p.y) - halfSize.y);
}

// Signed distance from a point in the shape's frame, metres.
KERNEL_FN float sdfLocalDistance(SdfSolid solid, vec3 p) {
    if (solid.shape <= kSdfRoundedBox) {
        const float rounding = sdfRounding(solid);
        return sdfBoxDistance(solid.halfSize - vec3(rounding), p) - rounding;
    }
    if (solid.shape == kSdfSphere) return length(p) - solid.halfSize.x;
    if (solid.shape == kSdfCapsule) return length(p - sdfOnSegment(solid.halfSize.y, p)) - solid.halfSize.x;
    if (solid.shape == kSdfCylinder) {
        const vec2 beyond = sdfBeyondCylinder(solid.halfSize, p);
        return length(max(beyond, vec2(0.0f))) + min(max(beyond.x, beyond.y), 0.0f);
    }
    return p.y;
}

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
    const float radius = length(vec2(p.x, p.z));
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
static_assert(offsetof(SdfSolid, shape) == 12 && offsetof(SdfSolid, rotation) == 16 &&
              offsetof(SdfSolid, halfSize) == 32 && offsetof(SdfSolid, rounding) == 44 && sizeof(SdfSolid) == 48);
static_assert(offsetof(SdfPaint, emission) == 12 && sizeof(SdfPaint) == 28);
}  // namespace probegi::kernels
#endif

#endif
