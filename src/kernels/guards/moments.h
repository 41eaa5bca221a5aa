// Chebyshev's test on the mean and mean square of the distances that probes store (sections 2.2 and 4.1). What a
// guard's functions mean is in list.h.
#if !defined(PROBEGI_KERNELS_MOMENTS_H) || defined(KERNELS_IN_LANES)
#define PROBEGI_KERNELS_MOMENTS_H

#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"
#include "kernels/lookup/probe_neighbours.h"

KERNELS_BEGIN

// How far a neighbour of the cage sees the point; `distance` in units of the farthest stored one, beyond which the
// moments cannot tell what is in the way.
KERNEL_FN Real neighbourVisibility(Real mean, Real meanSquare, Real distance) {
    return select(distance < 1.0f, chebyshevWeight(mean, meanSquare, distance, kRulesMeasured),
                  Real(chebyshevFloor(kRulesMeasured)));
}

LOOKUP_FN GuardPoint momentsPoint(IN(Access), IN(Volume), IN(Cage), IN(CageSlots)) {
    return noGuardPoint();
}

LOOKUP_FN Real momentsSeen(IN(Access) access, IN(Volume) v, Int slot, int, Real3 fromProbe, IN(GuardPoint)) {
    const OF_ACCESS(MapPoint) at = visibilityPoint(access, toWorldDirection(v, fromProbe));
    Real mean;
    Real meanSquare;
    storedMoments(access, slot, at, mean, meanSquare);
    return chebyshevWeight(mean, meanSquare, length(fromProbe) * v.inverseMaxDistance, access.rules);
}

LOOKUP_FN Real momentsBetween(IN(Access) access, IN(Volume) v, Int slot, Int, OF_ACCESS(MapPoint) along, Real distance,
                              Real3) {
    Real mean;
    Real meanSquare;
    momentsOnAxis(access, v, slot, along, mean, meanSquare);
    return chebyshevWeight(mean, meanSquare, distance * v.inverseMaxDistance, access.rules);
}

LOOKUP_FN Real3 momentsBegin(IN(Access), IN(Volume), IN(Cage)) {
    return Real3(vec3(0.0f));
}

LOOKUP_FN Real momentsFar(IN(Access) access, IN(Volume) v, Int slot, Real3 fromProbe, Real3) {
    const Real distance = length(fromProbe) + kNoLength;
    const OF_ACCESS(MapPoint) at = visibilityPoint(access, toWorldDirection(v, fromProbe / distance));
    Real mean;
    Real meanSquare;
    storedMoments(access, slot, at, mean, meanSquare);
    return neighbourVisibility(mean, meanSquare, distance * v.inverseMaxDistance);
}

KERNELS_END

#endif
