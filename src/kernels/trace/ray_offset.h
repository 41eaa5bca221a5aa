// Origin of a ray that leaves a surface, offset so that it neither hits that surface again nor skips a thin wall.
#ifndef PROBEGI_KERNELS_RAY_OFFSET_H
#define PROBEGI_KERNELS_RAY_OFFSET_H

#include "kernels/language.h"

KERNELS_BEGIN

// A hit position is accurate to a few ulp of the largest coordinate involved: its own, or those of its triangle's
// corners (bounded by the scene's extent, which counts less since large triangles far from the origin are rare). 32 ulp
// at 20 m are 76 micrometres: far below the thinnest wall (2 cm), far above the rounding of an intersection.
KERNEL_CONST float kOffsetUnits = 32.0f;
KERNEL_CONST float kSceneShare = 0.125f;

// `sceneMagnitude`: the largest absolute coordinate of the scene's bounds.
KERNEL_FN float rayOffset(vec3 position, float sceneMagnitude) {
    const float own = max(abs(position.x), max(abs(position.y), abs(position.z)));
    return kOffsetUnits * 1.1920929e-7f * max(own, kSceneShare * sceneMagnitude);
}

// `normal` is the geometric one, on the side where the ray leaves.
KERNEL_FN vec3 offsetOrigin(vec3 position, vec3 normal, float sceneMagnitude) {
    return position + normal * rayOffset(position, sceneMagnitude);
}

// End of the shadow ray to a light at this distance: slightly before it, so that a lamp embedded in a ceiling is not
// shadowed.
KERNEL_FN float shadowRayEnd(float lightDistance) {
    return lightDistance * (1.0f - 1e-4f);
}

KERNELS_END

#endif
