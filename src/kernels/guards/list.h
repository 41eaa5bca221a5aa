// The list of leak guards: which of the probes around a point it may use. A guard is a header of this folder with five
// functions (Access and GuardPoint are lookup/access.h's), of which three say 0..1:
//
//     // What the guard notes of a point, once, for the eight calls of the next. `slots`: of the cage's probes
//     GuardPoint NAMEPoint(Access access, Volume v, Cage cage, CageSlots slots)
//     // How far the point may use a probe of its cage, the one at `corner`. `fromProbe`: from the probe to the point
//     // with its bias, metres
//     Real NAMESeen(Access access, Volume v, Int slot, int corner, Real3 fromProbe, GuardPoint point)
//     // How far a probe sees the one that stands `distance` metres away along an axis of the volume, 2 axis + up being
//     // `side`. `along`: axisPoint(); `front`: where it stands
//     Real NAMEBetween(Access access, Volume v, Int slot, Int side, MapPoint along, Real distance, Real3 front)
//     // For a cage with too little weight, of one point in plain C++ and GLSL: where its ways to neighbours
//     // begin, once for the calls of the next; in the world, metres. A guard that goes no ways says 0
//     Real3 NAMEBegin(Access access, Volume v, Cage cage)
//     // NAMESeen() for a neighbour
//     Real NAMEFar(Access access, Volume v, Int slot, Real3 fromProbe, Real3 begin)
//
// Other vectors are in the volume's frame. A new guard has one include and one row here, and nothing else in kernels or
// shaders. In lanes (src/cpu/lanes-inl.h) this list and its headers are read a second time: hence KERNELS_IN_LANES.
#ifndef PROBEGI_KERNELS_LIST_H
#define PROBEGI_KERNELS_LIST_H

#include "kernels/guards/moments.h"
#include "kernels/guards/none.h"

// These ask the moments where they know nothing.
#include "kernels/guards/masks.h"
#include "kernels/guards/sdf_shadow.h"

// Number, and the five functions, in the order of probegi::LeakGuard.
#define PROBEGI_GUARDS(GUARD)                                                     \
    GUARD(0, nonePoint, noneSeen, noneBetween, noneBegin, noneFar)                \
    GUARD(1, momentsPoint, momentsSeen, momentsBetween, momentsBegin, momentsFar) \
    GUARD(2, masksPoint, masksSeen, masksBetween, masksBegin, masksFar)           \
    GUARD(3, sdfShadowPoint, sdfShadowSeen, sdfShadowBetween, sdfShadowBegin, sdfShadowFar)

#endif
