// The probe-position optimizer (section 5, Listing 4): a probe inside static geometry moves out through the nearest
// back that it sees, one close to a surface moves away from it. All in the volume's frame, lengths in metres.
#ifndef PROBEGI_KERNELS_RELOCATION_H
#define PROBEGI_KERNELS_RELOCATION_H

#include "kernels/lookup/probe_query.h"
#include "kernels/probe/solid_probe.h"

KERNELS_BEGIN

// Iterations; more let probes move to and fro through tangent backs.
KERNEL_CONST uint kRelocations = 5u;
// Looks around that place a probe: one for each iteration, and a last one from where it stands then.
KERNEL_FN uint looksOfPlacement(bool relocates) {
    return relocates ? kRelocations + 1u : 1u;
}
// Rays of each look, always the same.
KERNEL_CONST uint kRelocationRays = 128u;
// Farthest that a probe moves along an axis, in shares of the spacing.
KERNEL_CONST float kRelocationLimit = 0.45f;
// A step away from a close surface, in shares of the smallest spacing: Listing 4's 0.2 world units. Measured: it is
// enough to keep a distance of half that, for light is interpolated as if the probe stood in its place (RMS at surfaces
// of the built-in rooms 2.6 % with 0.1 as without, 4.1 with 0.2; house 14.3 % without, 13.0 and 12.9).
KERNEL_CONST float kRelocationStep = 0.2f;
KERNEL_CONST float kKeptDistance = 0.1f;

// What a probe's rays tell of its place.
struct PlaceSight {
    SidesSeen seen;
    float closestBack;   // distances: kNothingSeen if there is none
    vec3 toClosestBack;  // unit
    float closestFront;
    vec3 toClosestFront;
    float farthestFront;  // 0 if there is none
    vec3 toFarthestFront;
};
KERNEL_CONST float kNothingSeen = 1e30f;

KERNEL_FN PlaceSight nothingSeen() {
    PlaceSight sight;
    sight.seen.hits = 0;
    sight.seen.backs = 0;
    sight.seen.solidBacks = 0;
    sight.closestBack = kNothingSeen;
    sight.closestFront = kNothingSeen;
    sight.farthestFront = 0.0f;
    sight.toClosestBack = vec3(0.0f);
    sight.toClosestFront = vec3(0.0f);
    sight.toFarthestFront = vec3(0.0f);
    return sight;
}

// Adds a ray. `distance`: as RayDatum's, made safe; `solid`: hitBackface().
KERNEL_FN void addToPlaceSight(INOUT(PlaceSight) sight, vec3 direction, float distance, bool solid) {
    const bool hit = distance < kMissDistance;
    const bool back = hitBack(distance);
    sight.seen = addSides(sight.seen, packSides(hit, back, solid));
    if (back && -distance < sight.closestBack) {
        sight.closestBack = -distance;
        sight.toClosestBack = direction;
    }
    if (back || !hit) return;
    if (distance < sight.closestFront) {
        sight.closestFront = distance;
        sight.toClosestFront = direction;
    }
    if (distance > sight.farthestFront) {
        sight.farthestFront = distance;
        sight.toFarthestFront = direction;
    }
}

// Whether the rays say that the probe is inside static geometry. By the paper a quarter of all rays on backs does.
// Measured: backs of single-sided surfaces count among the hits; others only where there are hardly any fronts, since
// curtains and leaves show theirs to probes in the open.
KERNEL_FN bool isInside(SidesSeen seen, int rays, int rules) {
    if (rules == kRulesPaper) return float(seen.backs) > kInsideShare * float(rays);
    const bool enclosed = float(seen.hits - seen.backs) <= kNoFronts * float(rays);
    return backfaceShareOf(enclosed ? seen.backs : seen.solidBacks, seen.hits) > kInsideShare;
}

// Whether a probe that was placed is turned off. Look-ups fade probes out over a range of shares that updates measure
// with other rays: only those that are beyond it for certain are off.
KERNEL_CONST float kOffShare = 0.4f;
KERNEL_FN bool isOff(SidesSeen seen, int rays, int rules) {
    return isInside(seen, rays, rules) && (rules == kRulesPaper || backfaceShareOf(seen.backs, seen.hits) > kOffShare);
}

KERNEL_FN bool isWithin(vec3 offset, vec3 limit) {
    return abs(offset.x) < limit.x && abs(offset.y) < limit.y && abs(offset.z) < limit.z;
}

// How far one may go along an axis from `offset`, in units of `step`.
KERNEL_FN float roomAlong(float offset, float step, float limit) {
    return abs(step) > 0.0f ? (limit - (step > 0.0f ? offset : -offset)) / abs(step) : kNothingSeen;
}

// Through the closest back: at most twice the way to it, as far as the limit allows, in steps of a hundredth of the
// way; not at all if that is not beyond it. (The loop of Listing 4 as printed never begins; this is what its comment
// says.)
KERNEL_FN vec3 movedThroughBack(vec3 offset, vec3 toBack, vec3 limit) {
    const float room = min(roomAlong(offset.x, toBack.x, limit.x),
                           min(roomAlong(offset.y, toBack.y, limit.y), roomAlong(offset.z, toBack.z, limit.z)));
    const float scale = floor(min(room * 0.9999f, 2.0f) * 100.0f) * 0.01f;
    return scale >= 1.0f ? offset + scale * toBack : offset;
}

// Listing 4. `offset` is the probe's, the result its next one.
KERNEL_FN vec3 relocated(vec3 offset, PlaceSight sight, int rays, vec3 spacing, float minSpacing, int rules) {
    const vec3 limit = kRelocationLimit * spacing;
    if (isInside(sight.seen, rays, rules)) {
        if (sight.closestBack >= kNothingSeen) return offset;
        return movedThroughBack(offset, sight.closestBack * sight.toClosestBack, limit);
    }
    // The farthest front may also be the closest, if the probe sees but one surface: it stays then.
    if (sight.farthestFront <= 0.0f || dot(sight.toFarthestFront, sight.toClosestFront) > 0.5f) return offset;
    // The farthest front may lie almost along the closest one, and lead nowhere: measured, the way is straight away.
    const float way = kKeptDistance * minSpacing - sight.closestFront;
    if (rules != kRulesPaper && way <= 0.0f) return offset;
    const vec3 moved = rules == kRulesPaper
                           ? offset + min(kRelocationStep * minSpacing, sight.farthestFront) * sight.toFarthestFront
                           : offset - way * sight.toClosestFront;
    return isWithin(moved, limit) ? moved : offset;
}

KERNELS_END

#endif
