// Soft shadows of a scene of primitives, from the point itself to each probe (SDFDDGI, section 3.4): where a point sees
// a probe of its cage or of the cage's neighbours, walls of primitives do not leak, whatever probes store and however
// far apart they stand. Where it sees none, as in a sealed closet without a probe, moments decide, and light may leak.
// The paper steps along each way and takes the least of distance over way; this is that value in closed form
// (sdf/clearance.h), a ball around the probe being the light that casts the shadow. What a guard's functions mean is in
// list.h.
#if !defined(PROBEGI_KERNELS_SDF_SHADOW_H) || defined(KERNELS_IN_LANES)
#define PROBEGI_KERNELS_SDF_SHADOW_H

#ifndef KERNELS_IN_LANES  // there list.h has read it
#include "kernels/guards/moments.h"
#endif
#include "kernels/lookup/access.h"
#include "kernels/lookup/cage.h"
#include "kernels/sdf/way_out.h"

KERNELS_BEGIN

// Shares of the smallest spacing: the radius of the ball around a probe, how far in front of surfaces ways begin, and
// within which distance all of what stands in front of a surface must be to count as a part of it.
KERNEL_CONST float kShadowBall = 0.15f;
KERNEL_CONST float kShadowAhead = 0.02f;
// As little as leaves the folds of Sponza's curtains lit: in its nave (64 fitted boxes, spacing 1.5 m, 192 x 108
// pixels) 255 pixels have less than a fifth of the light that masks give them; 235 with 0.15, and 809 with 0. More
// would go through thin roofs close above cupboards: 0.06 of 1.5 m is 9 cm.
KERNEL_CONST float kShadowReach = 0.06f;
// Weight of what distance moments say where primitives hide all probes.
KERNEL_CONST float kShutIn = 0.001f;

// Where ways from a point begin: in front of its surface, outside the primitives in which it lies. In the world.
LOOKUP_FN Real3 shadowBegin(IN(Access) access, Real3 point, Real3 normal, float spacing) {
    const float ahead = kShadowAhead * spacing;
    const float reach = kShadowReach * spacing;
    Real3 begin = point + normal * ahead;
    // Out of one may be into another.
    for (int round = 0; round < 2; ++round) {
        for (int i = 0; i < access.blockers; ++i) {
            const SdfBlocker blocker = blockerAt(access, i);
            if (!anyOf(sdfIsNear(blocker, begin, Real3(vec3(reach))))) continue;
            const SdfSolid solid = blocker.solid;
            const Real3 way =
                sdfWayOutOf(solid, sdfToLocal(solid, begin - solid.centre), sdfToLocal(solid, normal), ahead, reach);
            begin = begin + sdfToWorld(solid, way);
        }
    }
    return begin;
}

// To the probes of the cage from where their ways begin, metres, in the world.
struct ShadowWays {
    Real3 to[8];
};

LOOKUP_FN ShadowWays waysToProbes(IN(Access) access, IN(Volume) v, IN(Cage) cage, IN(CageSlots) slots, Real3 begin) {
    const Real3 base = cage.base * v.spacing;
    ShadowWays ways;
    for (int corner = 0; corner < 8; ++corner) {
        Real3 place = base + Real3(vec3(corner & 1, (corner >> 1) & 1, corner >> 2) * v.spacing);
        if (v.relocated != 0) place = place + probeOffset(v, storedPlacement(access, cornerSlot(v, slots, corner)));
        ways.to[corner] = toWorldDirection(v, place) + (Real3(v.origin) - begin);
    }
    return ways;
}

// Radii of the balls around the probes of a cage, metres: as large as may be beside the nearest solid, and as large as
// the point sees in full.
struct ShadowBalls {
    Real whole[8];
    Real seen[8];
};

KERNEL_FN Real shareSeen(Real seen, Real whole) {
    return min(max(seen, Real(0.0f)) / max(whole, Real(1e-6f)), Real(1.0f));
}

KERNEL_FN GuardPoint noteOf(IN(ShadowBalls) balls) {
    GuardPoint note = noGuardPoint();
    for (int corner = 0; corner < 8; ++corner) note.seen[corner] = shareSeen(balls.seen[corner], balls.whole[corner]);
    return note;
}

// What a solid leaves of the ball around the end of a way from `from`, in the solid's frame, by `way`, in the world:
// the radius that it may have beside the solid, and that which its beginning sees.
KERNEL_FN void shadeBall(SdfSolid solid, Real3 from, Real3 way, INOUT(Real) whole, INOUT(Real) seen) {
    const Real3 own = sdfToLocal(solid, way);
    whole = min(whole, sdfEndClearance(solid, from + own));
    seen = min(seen, sdfClearance(solid, from, own));
}

LOOKUP_FN Real3 sdfShadowBegin(IN(Access) access, IN(Volume) v, IN(Cage) cage) {
    const Real3 point = toWorldDirection(v, cage.position - v.origin) + Real3(v.origin);
    return shadowBegin(access, point, toWorldDirection(v, cage.normal), v.minSpacing);
}

LOOKUP_FN GuardPoint sdfShadowPoint(IN(Access) access, IN(Volume) v, IN(Cage) cage, IN(CageSlots) slots) {
    const float ball = kShadowBall * v.minSpacing;
    const Real3 begin = sdfShadowBegin(access, v, cage);
    const ShadowWays ways = waysToProbes(access, v, cage, slots, begin);
    Real3 low = Real3(vec3(0.0f));
    Real3 high = Real3(vec3(0.0f));
    ShadowBalls balls;
    for (int corner = 0; corner < 8; ++corner) {
        low = Real3(min(low.x, ways.to[corner].x), min(low.y, ways.to[corner].y), min(low.z, ways.to[corner].z));
        high = Real3(max(high.x, ways.to[corner].x), max(high.y, ways.to[corner].y), max(high.z, ways.to[corner].z));
        balls.whole[corner] = Real(ball);
        balls.seen[corner] = Real(ball);
    }
    const Real3 middle = begin + (low + high) * 0.5f;
    const Real3 extent = (high - low) * 0.5f + Real3(vec3(ball));
    for (int i = 0; i < access.blockers; ++i) {
        const SdfBlocker blocker = blockerAt(access, i);
        if (!anyOf(sdfIsNear(blocker, middle, extent))) continue;
        const SdfSolid solid = blocker.solid;
        const Real3 from = sdfToLocal(solid, begin - solid.centre);
        for (int corner = 0; corner < 8; ++corner)
            shadeBall(solid, from, ways.to[corner], balls.whole[corner], balls.seen[corner]);
    }
    return noteOf(balls);
}

LOOKUP_FN Real sdfShadowSeen(IN(Access), IN(Volume), Int, int corner, Real3, IN(GuardPoint) point) {
    return point.seen[corner];
}

// The share of the ball around the end of a way, in the world, that its beginning sees.
LOOKUP_FN Real shadowAlong(IN(Access) access, Real3 begin, Real3 way, float ball) {
    const Real3 middle = begin + way * 0.5f;
    const Real3 extent = abs(way) * 0.5f + Real3(vec3(ball));
    Real whole = Real(ball);
    Real seen = Real(ball);
    for (int i = 0; i < access.blockers; ++i) {
        const SdfBlocker blocker = blockerAt(access, i);
        if (!anyOf(sdfIsNear(blocker, middle, extent))) continue;
        const SdfSolid solid = blocker.solid;
        shadeBall(solid, sdfToLocal(solid, begin - solid.centre), way, whole, seen);
    }
    return shareSeen(seen, whole);
}

LOOKUP_FN Real sdfShadowBetween(IN(Access) access, IN(Volume) v, Int, Int side, OF_ACCESS(MapPoint), Real distance,
                                Real3 front) {
    const Int axis = shiftedRight(side, Int(1));
    const Real3 begin = toWorldDirection(v, front - v.origin) + Real3(v.origin);
    return shadowAlong(access, begin, scaledBy(axisDirection(v, axis, Int(0) < (side & Int(1))), distance),
                       kShadowBall * v.minSpacing);
}

#ifndef KERNELS_IN_LANES  // which never ask neighbours
// By the moments where all ways are blocked, with a weight beside which any way that is free counts for all. The way
// begins where the cage's do: with the bias that moments need (`fromProbe`) it would begin beyond the far wall of a
// narrow room.
LOOKUP_FN Real sdfShadowFar(IN(Access) access, IN(Volume) v, Int slot, Real3 fromProbe, Real3 begin) {
    vec3 place = probePlace(v, probeCell(v, slot)) - v.origin;
    if (v.relocated != 0) place += probeOffset(v, storedPlacement(access, slot));
    const vec3 way = toWorldDirection(v, place) + (v.origin - begin);
    const float seen = shadowAlong(access, begin, way, kShadowBall * v.minSpacing);
    return max(seen, kShutIn * momentsFar(access, v, slot, fromProbe, begin));
}
#endif

KERNELS_END

#endif
