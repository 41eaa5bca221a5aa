// The list of leak guards: which of the probes around a point it may use. A guard is a header of this folder with three
// functions, each of which says 0..1 (Access is lookup/access.h's):
//
//     // How far the point may use a probe of its cage. `fromProbe`: from the probe to the point with its bias, metres
//     Real NAMESeen(Access access, Volume v, Int slot, Real3 fromProbe)
//     // How far a probe sees the one that stands `distance` metres away along an axis of the volume. `along`:
//     axisPoint() Real NAMEBetween(Access access, Volume v, Int slot, MapPoint along, Real distance)
//     // NAMESeen() for the neighbours of a cage with too little weight, of one point in plain C++ and GLSL
//     Real NAMEFar(Access access, Volume v, Int slot, Real3 fromProbe)
//
// Vectors are in the volume's frame. A new guard has one include and one row here, and nothing else in kernels or
// shaders. In lanes (src/cpu/lanes-inl.h) this list and its headers are read a second time: hence KERNELS_IN_LANES.
#ifndef PROBEGI_KERNELS_LIST_H
#define PROBEGI_KERNELS_LIST_H

#include "kernels/guards/moments.h"
#include "kernels/guards/none.h"

// Number, and the three functions, in the order of probegi::LeakGuard.
#define PROBEGI_GUARDS(GUARD)                \
    GUARD(0, noneSeen, noneBetween, noneFar) \
    GUARD(1, momentsSeen, momentsBetween, momentsFar)

#endif
