// A solid with an exact Euclidean distance (SDFDDGI, section 3.1), in C++ and GLSL.
#ifndef PROBEGI_KERNELS_SDF_SDF_SOLID_H
#define PROBEGI_KERNELS_SDF_SDF_SOLID_H

#include "kernels/language.h"

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

// Radius of a box's edges.
KERNEL_FN float sdfRounding(SdfSolid solid) {
    return solid.shape == kSdfRoundedBox ? solid.rounding : 0.0f;
}

// A solid, and half the extents of the box along the world's axes that holds it.
struct SdfBlocker {
    SdfSolid solid;
    vec3 reach;  // metres; of a plane kSdfFar
};

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(SdfSolid, shape) == 12 && offsetof(SdfSolid, rotation) == 16 &&
              offsetof(SdfSolid, halfSize) == 32 && offsetof(SdfSolid, rounding) == 44 && sizeof(SdfSolid) == 48);
static_assert(offsetof(SdfBlocker, reach) == 48 && sizeof(SdfBlocker) == 60);
}  // namespace probegi::kernels
#endif

#endif
