// Which share of the answer each of the eight probes around a point has (section 2.2, steps 1 to 3): trilinear, how far
// the probe faces the surface, what the leak guard says of it, whether it stands in a wall. And the weights of the
// pairs of probes that tell how light changes along the normal (surface_gradient.h). These are values of their own, so
// that what gathers light by them need not be this text's gather.h.
#ifndef PROBEGI_KERNELS_CAGE_WEIGHTS_H
#define PROBEGI_KERNELS_CAGE_WEIGHTS_H

#include "kernels/guards/guards.h"
#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"

KERNELS_BEGIN

// Bits 0 to 2 of a corner's number are its x, y and z in the cage.
struct CageWeights {
    Int slot[8];
    Real weight[8];
    Real weightSum;
    Real ahead;  // weighted mean of the probes' distance to the surface's plane, metres

    // A pair is a corner in front of the surface and the probe beyond it, in the slot of the former plus `step`.
    Int axis;
    Int up;        // 1: the pairs lie on the upper side of the axis, else 0
    Int step;      // 0 where there is no layer beyond
    Int front[4];  // the corners
    Real pair[4];
    Real pairSum;
    Real cells;  // by which the light was read in front of the surface
    Real trust;  // 0: the pairs do not count
};

// Corner of the cage in front of the surface, the k-th of four, in the order of their numbers.
KERNEL_FN Int frontCorner(Int axis, Int up, int k) {
    return componentOf(axis, up + 2 * k, up * 2 + ((k & 1) | ((k & 2) << 1)), up * 4 + k);
}

LOOKUP_FN void weighProbes(IN(Access) access, IN(Volume) v, IN(Cage) cage, IN(CageSlots) slots, INOUT(CageWeights) w) {
    const Real3 toBase = cage.base * v.spacing - (cage.position - v.origin);
    const GuardPoint point = guardPoint(access, v, cage, slots);
    Real weightSum = Real(0.0f);
    Real ahead = Real(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const int x = corner & 1;
        const int y = (corner >> 1) & 1;
        const int z = corner >> 2;
        const Int slot = cornerSlot(v, slots, corner);
        Real3 toProbe = toBase + Real3(vec3(x, y, z) * v.spacing);
        if (v.relocated != 0) toProbe = toProbe + probeOffset(v, storedPlacement(access, slot));
        const Real product = dot(toProbe, cage.normal);
        const Real facing = backfaceWeight(cosineToProbe(product, length(toProbe), v.minSpacing), access.rules);
        const Real visible =
            guardSeen(access, v, slot, corner, cage.bias - toProbe, point) * givenVisibility(access, corner);
        const Real trilinear = trilinearFactor(float(x), cage.alpha.x) * trilinearFactor(float(y), cage.alpha.y) *
                               trilinearFactor(float(z), cage.alpha.z);
        const Real weight =
            crushWeight(facing * visible) * trilinear * outsideWeight(storedBackfaceShare(access, slot), access.rules);
        weightSum = weightSum + weight;
        ahead = ahead + weight * product;
        w.slot[corner] = slot;
        w.weight[corner] = weight;
    }
    w.weightSum = weightSum;
    w.ahead = ahead / weightSum;
}

// Weight of the k-th corner in front.
KERNEL_FN Real frontWeight(IN(CageWeights) w, Bool alongX, Bool alongZ, Bool up, int k) {
    const int y = (k & 1) | ((k & 2) << 1);
    return select(alongX, select(up, w.weight[2 * k + 1], w.weight[2 * k]),
                  select(alongZ, select(up, w.weight[k + 4], w.weight[k]), select(up, w.weight[y + 2], w.weight[y])));
}

// Cells between the probes of a pair along its axis, from front to beyond.
LOOKUP_FN Real cellsBetween(IN(Access) access, IN(Volume) v, Int front, Int beyond, Int axis, Bool up) {
    const Real more = component(
        axis, probeOffset(v, storedPlacement(access, beyond)) - probeOffset(v, storedPlacement(access, front)));
    const Real cells = more * component(axis, Real3(v.inverseSpacing));
    // No nearer than a half: what two probes side by side differ by is mostly noise.
    return max(Real(0.5f), Real(1.0f) + select(up, cells, Real(0.0f) - cells));
}

// Where the probe at a corner of the cage stands, in the volume's frame.
LOOKUP_FN Real3 cornerPlace(IN(Access) access, IN(Volume) v, IN(Cage) cage, Int slot, Int corner) {
    const Real3 cell = Real3(toReal(corner & Int(1)), toReal(shiftedRight(corner, Int(1)) & Int(1)),
                             toReal(shiftedRight(corner, Int(2))));
    const Real3 place = (cage.base + cell) * v.spacing + Real3(v.origin);
    if (v.relocated == 0) return place;
    return place + probeOffset(v, storedPlacement(access, slot));
}

LOOKUP_FN void weighPairs(IN(Access) access, IN(Volume) v, IN(Cage) cage, IN(CageSlots) slots, INOUT(CageWeights) w) {
    w.axis = dominantAxis(cage.normal);
    const Bool alongX = w.axis == Int(0);
    const Bool alongZ = w.axis == Int(2);
    const Real onAxis = component(w.axis, cage.normal);
    const Bool up = onAxis > 0.0f;
    w.up = select(up, Int(1), Int(0));
    const Real beyond = component(w.axis, cage.base) + select(up, Real(2.0f), Real(-1.0f));
    const Bool known = beyond >= 0.0f && beyond < component(w.axis, Real3(vec3(v.counts))) && w.ahead > 0.0f;
    w.trust = select(known, axisTrust(cage.normal), Real(0.0f));
    if (!anyOf(w.trust > 0.0f)) return;

    // Places in the rings of the three axes: along the normal that of the corners in front, and both on the others.
    const int strideZ = v.counts.x * v.counts.y;
    const Int stride = componentOf(w.axis, 1, v.counts.x, strideZ);
    const Int ring = componentOf(w.axis, v.counts.x, strideZ, strideZ * v.counts.z);
    const Int front = componentOf(w.axis, select(up, slots.x[1], slots.x[0]), select(up, slots.y[1], slots.y[0]),
                                  select(up, slots.z[1], slots.z[0]));
    const Int next = front + select(up, stride, Int(0) - stride);
    const Int around = select(next < Int(0), next + ring, select(next < ring, next, next - ring));
    w.step = select(known, around - front, Int(0));
    const OF_ACCESS(MapPoint) along = axisPoint(access, v, w.axis, up);
    const Real spacing = component(w.axis, Real3(v.spacing));
    // The pair's weight is that of the probe in front, without the share that the point's depth gives to its layer.
    const Real depth = component(w.axis, cage.alpha);
    const Real alongAxis = Real(1.0f) / trilinearFactor(1.0f, select(up, depth, Real(1.0f) - depth));
    Real pairSum = Real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k) {
        const Int slot = front + select(alongX, slots.y[k & 1], slots.x[k & 1]) +
                         select(alongZ, slots.y[k >> 1], slots.z[k >> 1]) + v.firstSlot;
        const Real outside = outsideWeight(storedBackfaceShare(access, slot + w.step), kRulesMeasured);
        Real cells = Real(1.0f);
        Real distance = spacing;
        if (v.relocated != 0) {
            cells = cellsBetween(access, v, slot, slot + w.step, w.axis, up);
            distance = spacing * cells;
        }
        w.front[k] = frontCorner(w.axis, w.up, k);
        const Real pair = frontWeight(w, alongX, alongZ, up, k) * alongAxis * outside *
                          guardBetween(access, v, slot, w.axis + w.axis + w.up, along, distance,
                                       cornerPlace(access, v, cage, slot, w.front[k]));
        pairSum = pairSum + pair;
        w.pair[k] = pair;
        if (v.relocated != 0) w.pair[k] = pair / cells;
    }
    w.pairSum = pairSum;
    w.cells = cellsAhead(w.ahead, spacing, onAxis);
}

LOOKUP_FN CageWeights weighCage(IN(Access) access, IN(Volume) v, IN(Cage) cage) {
    const CageSlots slots = cageSlots(v, cage.base);
    CageWeights w;
    weighProbes(access, v, cage, slots, w);
    w.axis = Int(0);
    w.up = Int(0);
    w.step = Int(0);
    for (int k = 0; k < 4; ++k) {
        w.front[k] = Int(0);
        w.pair[k] = Real(0.0f);
    }
    w.pairSum = Real(0.0f);
    w.cells = Real(0.0f);
    w.trust = Real(0.0f);
    if (access.rules == kRulesMeasured) weighPairs(access, v, cage, slots, w);
    return w;
}

// One channel of E at the surface, W m^-2. `root`, `rise`: sums by the weights and by the pairs' (gather.h);
// `inverse`: 1 / weightSum.
KERNEL_FN Real irradianceAtSurface(IN(CageWeights) w, Real root, Real rise, Real inverse, int rules) {
    Real there = root * inverse;
    if (rules == kRulesMeasured) there = rootAtSurface(there, rise, w.pairSum, w.cells, w.trust);
    return there * there * kPi;
}

KERNELS_END

#endif
