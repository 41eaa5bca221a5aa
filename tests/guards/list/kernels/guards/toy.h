// A guard for tests: points may use probes with even slots only.
#if !defined(PROBEGI_KERNELS_TOY_H) || defined(KERNELS_IN_LANES)
#define PROBEGI_KERNELS_TOY_H

#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"

KERNELS_BEGIN

KERNEL_FN Real evenSlot(Int slot) {
    return select((slot & Int(1)) == Int(0), Real(1.0f), Real(0.0f));
}

// Whatever the point, so that this shows that the note reaches the other function.
LOOKUP_FN GuardPoint toyPoint(IN(Access), IN(Volume), IN(Cage), IN(CageSlots)) {
    GuardPoint point = noGuardPoint();
    point.high = Int(1);
    return point;
}

LOOKUP_FN Real toySeen(IN(Access), IN(Volume), Int slot, int, Real3, IN(GuardPoint) point) {
    return evenSlot(slot + point.high + Int(1));
}

// Of two neighbours along x, one has an odd slot.
LOOKUP_FN Real toyBetween(IN(Access), IN(Volume), Int, Int, OF_ACCESS(MapPoint), Real, Real3) {
    return Real(0.0f);
}

// That this reaches the next function, too.
LOOKUP_FN Real3 toyBegin(IN(Access), IN(Volume), IN(Cage)) {
    return Real3(vec3(1.0f));
}

LOOKUP_FN Real toyFar(IN(Access), IN(Volume), Int slot, Real3, Real3 begin) {
    return evenSlot(slot) * begin.x;
}

KERNELS_END

#endif
