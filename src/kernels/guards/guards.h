// The guards of list.h by number; one that is not there guards nothing.
#ifndef PROBEGI_KERNELS_GUARDS_H
#define PROBEGI_KERNELS_GUARDS_H

#include "kernels/guards/list.h"

KERNELS_BEGIN

LOOKUP_FN GuardPoint guardPoint(IN(Access) access, IN(Volume) v, IN(Cage) cage, IN(CageSlots) slots) {
#define GUARD(number, point, seen, between, origin, farther) \
    if (access.guard == number) return point(access, v, cage, slots);
    PROBEGI_GUARDS(GUARD)
#undef GUARD
    return noGuardPoint();
}

LOOKUP_FN Real guardSeen(IN(Access) access, IN(Volume) v, Int slot, int corner, Real3 fromProbe, IN(GuardPoint) of) {
#define GUARD(number, point, seen, between, origin, farther) \
    if (access.guard == number) return seen(access, v, slot, corner, fromProbe, of);
    PROBEGI_GUARDS(GUARD)
#undef GUARD
    return Real(1.0f);
}

LOOKUP_FN Real guardBetween(IN(Access) access, IN(Volume) v, Int slot, Int side, OF_ACCESS(MapPoint) along,
                            Real distance, Real3 front) {
#define GUARD(number, point, seen, between, origin, farther) \
    if (access.guard == number) return between(access, v, slot, side, along, distance, front);
    PROBEGI_GUARDS(GUARD)
#undef GUARD
    return Real(1.0f);
}

LOOKUP_FN Real3 guardBegin(IN(Access) access, IN(Volume) v, IN(Cage) cage) {
#define GUARD(number, point, seen, between, origin, farther) \
    if (access.guard == number) return origin(access, v, cage);
    PROBEGI_GUARDS(GUARD)
#undef GUARD
    return Real3(vec3(0.0f));
}

LOOKUP_FN Real guardFar(IN(Access) access, IN(Volume) v, Int slot, Real3 fromProbe, Real3 begin) {
#define GUARD(number, point, seen, between, origin, farther) \
    if (access.guard == number) return farther(access, v, slot, fromProbe, begin);
    PROBEGI_GUARDS(GUARD)
#undef GUARD
    return Real(1.0f);
}

KERNELS_END

#endif
