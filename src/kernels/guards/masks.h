// Baked visibility (Zhou et al., "Fast Probe-Leaking Elimination Using Mask Decomposition", section 3). Each place sees
// some clusters of probes, and its answer is the mean of theirs: eq. 3, divided by the same sum of the weights alone.
// (As printed it darkens: m g are not normalised.) That sum over clusters is one over the eight probes of the cage with
// phi m[g] for weights, so a look-up does what it does with any guard. Where a place sees no cluster, distance moments
// tell. What a guard's functions mean is in list.h.
//
// The words (maskWord() of lookup/access.h): of each slot two, then the cubes.
//   2 slot      number of the first word of the cube of the cell whose lowest probe is in the slot
//   2 slot + 1  bits 0 to 2: the probe's cluster; bit 8 + 2 axis + up: the probe sees the next one along the axis
//   cubes       texels, x fastest, maskTexels an axis from face to face of the cell, four to a word, lowest byte first;
//               bit k of a texel: it sees cluster k; 0: it is blind
// A cube is read within its cell only: one cell's clusters say nothing of the next one's.
#if !defined(PROBEGI_KERNELS_MASKS_H) || defined(KERNELS_IN_LANES)
#define PROBEGI_KERNELS_MASKS_H

#ifndef KERNELS_IN_LANES  // there list.h has read it
#include "kernels/guards/moments.h"
#endif
#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"

KERNELS_BEGIN

// A point on a surface looks a texel ahead on each axis along which its normal points: no texel that it then blends is
// behind the surface. This is the component of the unit normal from which on it does so in full.
KERNEL_CONST float kFullPush = 0.25f;
// What the weights of eight texels add up to, up to 4 more since each is rounded: four sums in a word have no sign bit.
KERNEL_CONST float kMaskScale = 120.0f;

KERNEL_FN Int maskCluster(Int word) {
    return word & Int(7);
}

// Four bits -> four bytes of 0 or 1.
KERNEL_FN Int spreadBits(Int bits) {
    return (bits * Int(0x204081)) & Int(0x01010101);
}

// Trilinear between the texels around a place. `texel`: the place in the cube, 0..maskTexels-1 an axis; `cube`: the
// first word.
LOOKUP_FN GuardPoint maskPointAt(IN(Access) access, Int cube, Real3 texel) {
    const int texels = access.maskTexels;
    const Real3 corner = clamp(floor(texel), vec3(0.0f), vec3(float(texels - 2)));
    const Real3 high = texel - corner;
    const Int first = toInt(corner.x + (corner.y + corner.z * float(texels)) * float(texels));
    GuardPoint point;
    point.low = Int(0);
    point.high = Int(0);
    UNROLL for (int i = 0; i < 8; ++i) {
        const Real x = (i & 1) != 0 ? high.x : Real(1.0f) - high.x;
        const Real y = (i & 2) != 0 ? high.y : Real(1.0f) - high.y;
        const Real z = (i & 4) != 0 ? high.z : Real(1.0f) - high.z;
        const Int weight = toInt(x * y * z * kMaskScale + 0.5f);
        const Int at = first + Int((i & 1) + texels * (((i >> 1) & 1) + texels * (i >> 2)));
        const Int bits = shiftedRight(maskWord(access, cube + shiftedRight(at, Int(2))), (at & Int(3)) * Int(8));
        point.low = point.low + weight * spreadBits(bits & Int(15));
        point.high = point.high + weight * spreadBits(shiftedRight(bits, Int(4)) & Int(15));
    }
    return point;
}

// `slot`: of the cage's lowest probe.
LOOKUP_FN GuardPoint masksPoint(IN(Access) access, IN(Volume) v, IN(Cage) cage, Int slot) {
    const float last = float(access.maskTexels - 1);
    const Real3 inCell = clamp(gridCoordinates(v, cage.position) - cage.base, vec3(0.0f), vec3(1.0f)) * last;
    const Real3 ahead = clamp(cage.normal * (1.0f / kFullPush), vec3(-1.0f), vec3(1.0f));
    return maskPointAt(access, maskWord(access, slot + slot), clamp(inCell + ahead, vec3(0.0f), vec3(last)));
}

// Share of a cluster at a point.
KERNEL_FN Real maskOf(IN(GuardPoint) point, Int cluster) {
    const Int four = select(cluster < Int(4), point.low, point.high);
    return toReal(shiftedRight(four, (cluster & Int(3)) * Int(8)) & Int(255)) * (1.0f / kMaskScale);
}

LOOKUP_FN Real masksSeen(IN(Access) access, IN(Volume) v, Int slot, Real3 fromProbe, IN(GuardPoint) point) {
    const Real mask = maskOf(point, maskCluster(maskWord(access, slot + slot + Int(1))));
    const Bool blind = point.low == Int(0) && point.high == Int(0);
    if (!anyOf(blind)) return mask;
    return select(blind, momentsSeen(access, v, slot, fromProbe, point), mask);
}

LOOKUP_FN Real masksBetween(IN(Access) access, IN(Volume), Int slot, Int side, OF_ACCESS(MapPoint), Real) {
    const Int links = maskWord(access, slot + slot + Int(1));
    return toReal(shiftedRight(links, side + Int(8)) & Int(1));
}

LOOKUP_FN Real masksFar(IN(Access) access, IN(Volume) v, Int slot, Real3 fromProbe) {
    return momentsFar(access, v, slot, fromProbe);
}

KERNELS_END

#endif
