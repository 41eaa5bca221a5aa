// The leaking baseline: every probe is as good as its place. What a guard's functions mean is in list.h.
#if !defined(PROBEGI_KERNELS_NONE_H) || defined(KERNELS_IN_LANES)
#define PROBEGI_KERNELS_NONE_H

#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"

KERNELS_BEGIN

LOOKUP_FN GuardPoint nonePoint(IN(Access), IN(Volume), IN(Cage), IN(CageSlots)) {
    return noGuardPoint();
}

LOOKUP_FN Real noneSeen(IN(Access), IN(Volume), Int, int, Real3, IN(GuardPoint)) {
    return Real(1.0f);
}

LOOKUP_FN Real noneBetween(IN(Access), IN(Volume), Int, Int, OF_ACCESS(MapPoint), Real, Real3) {
    return Real(1.0f);
}

LOOKUP_FN Real3 noneBegin(IN(Access), IN(Volume), IN(Cage)) {
    return Real3(vec3(0.0f));
}

LOOKUP_FN Real noneFar(IN(Access), IN(Volume), Int, Real3, Real3) {
    return Real(1.0f);
}

KERNELS_END

#endif
