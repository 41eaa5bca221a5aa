// What a look-up asks of whoever includes it. The text of kernels/guards, cage_weights.h, gather.h and irradiance.h
// knows a field by an Access alone. In GLSL that is a struct, defined before these headers are included, as are the
// functions below; in C++ a class of any name, for the text is templates there, with its functions beside it.
//
//     int rules;             // members: kRulesMeasured or kRulesPaper
//     int guard;             // number of the leak guard (kernels/guards/list.h)
//     float selfShadowBias;  // FieldSettings'
//
//     MapPoint               // a type, in C++ a member of Access: where a direction lies in the probes' maps
//     MapPoint visibilityPoint(Access access, Real3 direction)    // of the world, of any length but 0
//     MapPoint irradiancePoint(Access access, vec3 normal)
//     MapPoint axisPoint(Access access, Volume v, Int axis, Bool up)              // visibilityPoint() of an axis of v
//
//     // Of the distances that a probe sees, as shares of the farthest: the mean and the mean square.
//     void storedMoments(Access access, Int slot, MapPoint at, OUT(Real) mean, OUT(Real) meanSquare)
//     // The same at an axisPoint().
//     void momentsOnAxis(Access access, Volume v, Int slot, MapPoint at, OUT(Real) mean, OUT(Real) meanSquare)
//     Real storedBackfaceShare(Access access, Int slot)
//     Int storedPlacement(Access access, Int slot)           // probe_offset.h; of a relocated volume only
//     vec3 storedIrradiance(Access access, int slot, MapPoint at)                 // encoded
//
//     // Visibility of a corner of the cage that another pass found, say in screen space: it multiplies what the guard
//     // says of the probe. 1 where there is none.
//     Real givenVisibility(Access access, int corner)
//
//     // With the guard of masks (guards/masks.h has the layout):
//     int maskTexels;                                        // members: along a cell's edge
//     int maskPacked;                                        // whether two texels share a word
//     Int maskWord(Access access, Int number)
//     // The solids of guards/sdf_shadow.h, 0 <= number < access.blockers, another member.
//     SdfBlocker blockerAt(Access access, int number)
//     void countFallback(Access access)                      // called by a look-up whose cage has too little weight
//
// A look-up in several volumes asks a few more: volume_blend.h.
#ifndef PROBEGI_KERNELS_ACCESS_H
#define PROBEGI_KERNELS_ACCESS_H

#include "kernels/lookup/probe_query.h"
#include "kernels/lookup/surface_gradient.h"
#include "kernels/sdf/sdf_solid.h"
#include "kernels/volume/probe_offset.h"

#ifdef __cplusplus
#define LOOKUP_FN           \
    template <class Access> \
    KERNEL_FN
#define OF_ACCESS(T) typename Access::T
#else
#define LOOKUP_FN
#define OF_ACCESS(T) T
#endif

KERNELS_BEGIN

// What a leak guard notes of a point before it is asked about the probes of its cage (guards/list.h).
struct GuardPoint {
    Int low;
    Int high;
    Real scale;
    Real seen[8];  // by corner of the cage
};

KERNEL_FN GuardPoint noGuardPoint() {
    GuardPoint point;
    point.low = Int(0);
    point.high = Int(0);
    point.scale = Real(0.0f);
    UNROLL for (int corner = 0; corner < 8; ++corner) point.seen[corner] = Real(0.0f);
    return point;
}

// One component of a vector, of axis 0 to 2.
KERNEL_FN Real component(Int axis, Real3 v) {
    return select(axis == Int(0), v.x, select(axis == Int(1), v.y, v.z));
}
KERNEL_FN Int componentOf(Int axis, Int x, Int y, Int z) {
    return select(axis == Int(0), x, select(axis == Int(1), y, z));
}

// The direction in the world of an axis of a volume.
KERNEL_FN Real3 axisDirection(IN(Volume) v, Int axis, Bool up) {
    const Real along = select(up, Real(1.0f), Real(-1.0f));
    const Real none = Real(0.0f);
    return toWorldDirection(v, Real3(select(axis == Int(0), along, none), select(axis == Int(1), along, none),
                                     select(axis == Int(2), along, none)));
}

KERNELS_END

#endif
