// Baked visibility (Zhou et al., "Fast Probe-Leaking Elimination Using Mask Decomposition", section 3). Each place sees
// some clusters of probes, and its answer is the mean of theirs: eq. 3, divided by the same sum of the weights alone.
// (As printed it darkens: m g are not normalised.) That sum over clusters is one over the eight probes of the cage with
// phi m[g] for weights, so a look-up does what it does with any guard. Of that it keeps what eq. 3 does not have: the
// weights by facing, and the crush of small ones (cage_weights.h). Where a place sees no cluster, distance moments
// tell. What a guard's functions mean is in list.h.
//
// The words (maskWord() of lookup/access.h): of each slot two, then the cubes.
//   2 slot      number of the first word of the cube of the cell whose lowest probe is in the slot
//   2 slot + 1  bits 0 to 2: the probe's cluster; bit 8 + 2 axis + up: the probe sees the next one along the axis
//   cubes       texels, x fastest, maskTexels an axis from face to face of the cell;
//               a word each, or, with maskPacked, half a word, the lower half first:
//               these have clusters 0 to 3 only
//   texel       bits 0 to 3 and 16 to 19: it sees clusters 0 to 3 and 4 to 7; no bit: it is blind
//               bits 4 to 7, 8 to 11, 12 to 15: on the way to the next texel along x, y, z is a wall beyond which
//               others are seen: 1 to 15 for 0 to 1 of the way; 0: there is none
// A cube is read within its cell only: one cell's clusters say nothing of the next one's.
#if !defined(PROBEGI_KERNELS_MASKS_H) || defined(KERNELS_IN_LANES)
#define PROBEGI_KERNELS_MASKS_H

#ifndef KERNELS_IN_LANES  // there list.h has read it
#include "kernels/guards/moments.h"
#endif
#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"

KERNELS_BEGIN

// Texels by which a point on a surface looks ahead along its normal, so that it is beyond doubt on its side of walls.
KERNEL_CONST float kMaskAhead = 0.5f;
// Weight of the ways that a wall crosses, of the four along an axis, from which on a point is on one side of it.
KERNEL_CONST float kLeastWall = 0.02f;
// What the weights of eight texels add up to, up to 4 more since each is rounded: four sums in a word have no sign bit.
KERNEL_CONST float kMaskScale = 120.0f;

KERNEL_FN Int maskCluster(Int word) {
    return word & Int(7);
}

// Four bits -> four bytes of 0 or 1.
KERNEL_FN Int spreadBits(Int bits) {
    return (bits * Int(0x204081)) & Int(0x01010101);
}

LOOKUP_FN Int maskTexel(IN(Access) access, Int cube, Int texel) {
    if (access.maskPacked == 0) return maskWord(access, cube + texel);
    const Int two = maskWord(access, cube + shiftedRight(texel, Int(1)));
    return shiftedRight(two, (texel & Int(1)) * Int(16)) & Int(0xffff);
}

// Trilinear factor of the upper or lower side.
KERNEL_FN Real sideFactor(Real high, int upper) {
    return upper != 0 ? high : Real(1.0f) - high;
}

// A wall on the way from a texel to the next, `bit` being the lowest of its four: sums of places and of weights.
KERNEL_FN void addWall(Int texel, int bit, Real weight, INOUT(Real) places, INOUT(Real) weights) {
    const Int place = shiftedRight(texel, Int(bit)) & Int(15);
    const Bool there = Int(0) < place;
    places = places + select(there, weight * ((toReal(place) - 1.0f) * (1.0f / 14.0f)), Real(0.0f));
    weights = weights + select(there, weight, Real(0.0f));
}

// A point between two texels goes to the one on its side of the wall, if there is one.
KERNEL_FN Real onItsSide(Real high, Real places, Real weights) {
    return select(weights > kLeastWall, select(high * weights < places, Real(0.0f), Real(1.0f)), high);
}

// Trilinear between the texels around a place that are on its side of walls. `texel`: the place in the cube,
// 0..maskTexels-1 an axis; `cube`: the first word.
LOOKUP_FN GuardPoint maskPointAt(IN(Access) access, Int cube, Real3 texel) {
    const int texels = access.maskTexels;
    const Real3 corner = clamp(floor(texel), vec3(0.0f), vec3(float(texels - 2)));
    Real3 high = texel - corner;
    const Int first = toInt(corner.x + (corner.y + corner.z * float(texels)) * float(texels));
    Int around[8];
    UNROLL for (int i = 0; i < 8; ++i) around[i] =
        maskTexel(access, cube, first + Int((i & 1) + texels * (((i >> 1) & 1) + texels * (i >> 2))));
    Real places = Real(0.0f);
    Real weights = Real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k)
        addWall(around[2 * k], 4, sideFactor(high.y, k & 1) * sideFactor(high.z, k >> 1), places, weights);
    high.x = onItsSide(high.x, places, weights);
    places = Real(0.0f);
    weights = Real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k) addWall(around[(k & 1) + 4 * (k >> 1)], 8,
                                               sideFactor(high.x, k & 1) * sideFactor(high.z, k >> 1), places, weights);
    high.y = onItsSide(high.y, places, weights);
    places = Real(0.0f);
    weights = Real(0.0f);
    UNROLL for (int k = 0; k < 4; ++k)
        addWall(around[k], 12, sideFactor(high.x, k & 1) * sideFactor(high.y, k >> 1), places, weights);
    high.z = onItsSide(high.z, places, weights);
    GuardPoint point = noGuardPoint();
    Int seeing = Int(0);
    UNROLL for (int i = 0; i < 8; ++i) {
        const Real share = sideFactor(high.x, i & 1) * sideFactor(high.y, i & 2) * sideFactor(high.z, i & 4);
        const Int clusters = around[i] & Int(0xf000f);
        const Int weight = select(clusters == Int(0), Int(0), toInt(share * kMaskScale + 0.5f));
        point.low = point.low + weight * spreadBits(clusters & Int(15));
        point.high = point.high + weight * spreadBits(shiftedRight(clusters, Int(16)));
        seeing = seeing + weight;
    }
    // Blind texels do not count.
    point.scale = select(Int(0) < seeing, Real(1.0f) / toReal(seeing), Real(0.0f));
    return point;
}

LOOKUP_FN GuardPoint masksPoint(IN(Access) access, IN(Volume) v, IN(Cage) cage, IN(CageSlots) slots) {
    const Int slot = cornerSlot(v, slots, 0);
    const float last = float(access.maskTexels - 1);
    const Real3 inCell = clamp(gridCoordinates(v, cage.position) - cage.base, vec3(0.0f), vec3(1.0f)) * last;
    return maskPointAt(access, maskWord(access, slot + slot),
                       clamp(inCell + cage.normal * kMaskAhead, vec3(0.0f), vec3(last)));
}

// Share of a cluster at a point; 0 of all at a blind one.
KERNEL_FN Real maskOf(IN(GuardPoint) point, Int cluster) {
    const Int four = select(cluster < Int(4), point.low, point.high);
    return toReal(shiftedRight(four, (cluster & Int(3)) * Int(8)) & Int(255)) * point.scale;
}

LOOKUP_FN Real masksSeen(IN(Access) access, IN(Volume) v, Int slot, int corner, Real3 fromProbe, IN(GuardPoint) point) {
    const Real mask = maskOf(point, maskCluster(maskWord(access, slot + slot + Int(1))));
    const Bool blind = point.scale < 0.001f;
    if (!anyOf(blind)) return mask;
    return select(blind, momentsSeen(access, v, slot, corner, fromProbe, point), mask);
}

LOOKUP_FN Real masksBetween(IN(Access) access, IN(Volume), Int slot, Int side, OF_ACCESS(MapPoint), Real, Real3) {
    const Int links = maskWord(access, slot + slot + Int(1));
    return toReal(shiftedRight(links, side + Int(8)) & Int(1));
}

LOOKUP_FN Real3 masksBegin(IN(Access), IN(Volume), IN(Cage)) {
    return Real3(vec3(0.0f));
}

LOOKUP_FN Real masksFar(IN(Access) access, IN(Volume) v, Int slot, Real3 fromProbe, Real3 begin) {
    return momentsFar(access, v, slot, fromProbe, begin);
}

KERNELS_END

#endif
