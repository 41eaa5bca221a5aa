// What goes into a field and what it is asked: C++ and GLSL.
#ifndef PROBEGI_SHARED_FIELD_DATA_H
#define PROBEGI_SHARED_FIELD_DATA_H

#include "probegi/shared/language.h"

PROBEGI_SHARED_BEGIN

/// One probe to update.
struct ProbeTask {
    PROBEGI_VEC3 origin PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));  ///< where its rays begin, metres
    PROBEGI_UINT slot PROBEGI_DEFAULT(0);                     ///< of the probe, counted over all volumes
    PROBEGI_UINT volume PROBEGI_DEFAULT(0);                   ///< that it belongs to
};

/// The result of one ray of one probe. This is the seam for engines with a ray tracer of their own.
/// Where the ray met the back of a surface, as its winding has it, `distance` is negative. A single-sided surface is
/// solid wall from there: a backface, whose radiance does not count. What a surface with two sides sends from its back
/// counts, and comes negative too (a black one: -1e-30): a probe that sees mostly backs may stand in a wall, whatever
/// their material.
struct RayDatum {
    /// W sr^-1 m^-2 arriving at the probe; a channel not in 0..1e30 counts as 0.
    PROBEGI_VEC3 radiance PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
    /// Metres; negative: minus the distance to a back; a miss: anything >= 1e27.
    float distance PROBEGI_DEFAULT(0.0f);
};

/// A RayDatum in 8 bytes, for engines to which memory traffic counts: packRay(), or in shaders probegiPackRay() of
/// query.glsl.
struct PackedRayDatum {
    /// As VK_FORMAT_E5B9G9R9_UFLOAT_PACK32: within 0.2 % of the largest channel; at most 65408, what is above becomes
    /// that, what is below 3e-8 becomes 0. Without sign.
    PROBEGI_UINT radiance PROBEGI_DEFAULT(0);
    /// As RayDatum::distance. Where it is negative, its lowest bit is 1 if the surface has two sides.
    float distance PROBEGI_DEFAULT(0.0f);
};

/// The result of one fixed ray of one probe: both lights add up to what a RayDatum of that direction holds.
struct FixedRayDatum {
    /// Luminance of light from lights, emission and sky, W sr^-1 m^-2; not in 0..1e30: counts as 0.
    float direct PROBEGI_DEFAULT(0);
    float bounced PROBEGI_DEFAULT(0);   ///< luminance of light that the surface got from the field; the same
    float distance PROBEGI_DEFAULT(0);  ///< as RayDatum::distance
};

/// A question to the field: how much light arrives at `position` on a surface that faces `normal`?
struct FieldQuery {
    PROBEGI_VEC3 position PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
    PROBEGI_VEC3 normal PROBEGI_DEFAULT(PROBEGI_VEC3(0, 1, 0));  ///< unit
    /// Unit, omega_o of eq. 2; zero: there is no viewer, and the normal takes its place.
    PROBEGI_VEC3 toViewer PROBEGI_DEFAULT(PROBEGI_VEC3(0.0f));
};

#ifdef __cplusplus
static_assert(sizeof(ProbeTask) == 20 && offsetof(ProbeTask, slot) == 12 && offsetof(ProbeTask, volume) == 16);
static_assert(sizeof(RayDatum) == 16 && offsetof(RayDatum, distance) == 12);
static_assert(sizeof(PackedRayDatum) == 8 && offsetof(PackedRayDatum, distance) == 4);
static_assert(sizeof(FixedRayDatum) == 12 && offsetof(FixedRayDatum, bounced) == 4 &&
              offsetof(FixedRayDatum, distance) == 8);
static_assert(sizeof(FieldQuery) == 36 && offsetof(FieldQuery, normal) == 12 && offsetof(FieldQuery, toViewer) == 24);
#endif

PROBEGI_SHARED_END

#endif
