// The library's list with another guard.
#ifndef PROBEGI_KERNELS_LIST_H
#define PROBEGI_KERNELS_LIST_H

#include "kernels/guards/moments.h"
#include "kernels/guards/none.h"
#include "kernels/guards/toy.h"

// These ask the moments where they know nothing.
#include "kernels/guards/masks.h"
#include "kernels/guards/sdf_shadow.h"

#define PROBEGI_GUARDS(GUARD)                                                               \
    GUARD(0, nonePoint, noneSeen, noneBetween, noneBegin, noneFar)                          \
    GUARD(1, momentsPoint, momentsSeen, momentsBetween, momentsBegin, momentsFar)           \
    GUARD(2, masksPoint, masksSeen, masksBetween, masksBegin, masksFar)                     \
    GUARD(3, sdfShadowPoint, sdfShadowSeen, sdfShadowBetween, sdfShadowBegin, sdfShadowFar) \
    GUARD(4, toyPoint, toySeen, toyBetween, toyBegin, toyFar)

#endif
