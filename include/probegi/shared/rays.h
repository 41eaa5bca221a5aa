// Rays, what they hit, and what that looks like: C++ and GLSL.
#ifndef PROBEGI_SHARED_RAYS_H
#define PROBEGI_SHARED_RAYS_H

#include "probegi/shared/language.h"

PROBEGI_SHARED_BEGIN

/// A half-line. Hits closer than `near` or farther than `far` do not count.
struct Ray {
    PROBEGI_VEC3 origin PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
    float near PROBEGI_DEFAULT(0.0f);                               ///< metres
    PROBEGI_VEC3 direction PROBEGI_DEFAULT(PROBEGI_VEC3(0, 0, 1));  ///< unit
    float far PROBEGI_DEFAULT(1e30f);                               ///< metres
};

/// The closest surface along a Ray. `primitive < 0`: nothing was hit.
struct Hit {
    float distance PROBEGI_DEFAULT(1e30f);                         ///< metres along the ray
    PROBEGI_INT primitive PROBEGI_DEFAULT(-1);                     ///< tracer-specific triangle or SDF primitive number
    PROBEGI_INT geometry PROBEGI_DEFAULT(-1);                      ///< tracer-specific
    PROBEGI_INT instance PROBEGI_DEFAULT(-1);                      ///< tracer-specific
    PROBEGI_VEC2 barycentric PROBEGI_DEFAULT(PROBEGI_VEC2(0.0f));  ///< weights of the second and third corner
#ifdef __cplusplus
    bool valid() const {
        return primitive >= 0;
    }
#endif
};

/// Shading data of a hit: geometry and material resolved, textures sampled. Normals face the ray's origin.
/// Not for buffers: a bool has no size in GLSL (src/kernels/abi/gpu_passes.h has GpuSurface).
struct Surface {
    PROBEGI_VEC3 position PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
    /// Unit, on the side the ray came from.
    PROBEGI_VEC3 geometricNormal PROBEGI_DEFAULT(PROBEGI_VEC3(0, 1, 0));
    /// Unit, interpolated and normal-mapped, on the same side as the ray's origin.
    PROBEGI_VEC3 shadingNormal PROBEGI_DEFAULT(PROBEGI_VEC3(0, 1, 0));
    PROBEGI_VEC3 albedo PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));  ///< base colour, 0..1
    /// Radiance towards the ray's origin, W sr^-1 m^-2 (0 on a backface).
    PROBEGI_VEC3 emission PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
    float metallic PROBEGI_DEFAULT(0.0f);
    float roughness PROBEGI_DEFAULT(1.0f);
    PROBEGI_INT material PROBEGI_DEFAULT(-1);  ///< index into Scene::materials; -1: the tracer knows no materials
    bool back PROBEGI_DEFAULT(false);          ///< the ray met the back, by winding, whatever the material
    bool backface PROBEGI_DEFAULT(false);      ///< the back of a single-sided material: solid wall
};

#ifdef __cplusplus
static_assert(sizeof(Ray) == 32 && offsetof(Ray, near) == 12 && offsetof(Ray, direction) == 16 &&
              offsetof(Ray, far) == 28);
static_assert(sizeof(Hit) == 24 && offsetof(Hit, primitive) == 4 && offsetof(Hit, geometry) == 8 &&
              offsetof(Hit, instance) == 12 && offsetof(Hit, barycentric) == 16);
#endif

PROBEGI_SHARED_END

#endif
