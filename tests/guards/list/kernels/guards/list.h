// The library's list with another guard.
#ifndef PROBEGI_KERNELS_LIST_H
#define PROBEGI_KERNELS_LIST_H

#include "kernels/guards/moments.h"
#include "kernels/guards/none.h"
#include "kernels/guards/toy.h"

#define PROBEGI_GUARDS(GUARD)                         \
    GUARD(0, noneSeen, noneBetween, noneFar)          \
    GUARD(1, momentsSeen, momentsBetween, momentsFar) \
    GUARD(2, toySeen, toyBetween, toyFar)

#endif
