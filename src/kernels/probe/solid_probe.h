// Whether a probe is inside solid matter. The paper uses the share of backfaces among the hits of a probe's rays
// (section 4.1, Listing 4), but a double-sided surface has no backface. Geometry decides instead: the winding tells
// which side a ray hits, whatever the material. A probe that sees mostly backs is in a wall, in the void outside a
// level's hull, or behind a sheet with open edges: a curtain, leaves. In the last case it also sees fronts, and has a
// clear line to a probe in the open, or to one that has such a line.
#ifndef PROBEGI_KERNELS_SOLID_PROBE_H
#define PROBEGI_KERNELS_SOLID_PROBE_H

#include "kernels/blend/probe_blend.h"
#include "kernels/lookup/probe_query.h"

KERNELS_BEGIN

// What a probe's rays hit in one frame.
struct SidesSeen {
    int hits;        // of any surface
    int backs;       // of these, on backs by winding, whatever the material
    int solidBacks;  // of these, on backs of single-sided materials
};

// The same for up to 1,023 rays in 32 bits; packed values can be added up.
KERNEL_FN uint packSides(bool hit, bool back, bool solidBack) {
    return (hit ? 1u : 0u) + (back ? 0x400u : 0u) + (solidBack ? 0x100000u : 0u);
}
KERNEL_FN SidesSeen addSides(SidesSeen seen, uint packed) {
    seen.hits += int(packed & 0x3ffu);
    seen.backs += int((packed >> 10u) & 0x3ffu);
    seen.solidBacks += int(packed >> 20u);
    return seen;
}

// A probe's state, kept from frame to frame.
struct ProbeSides {
    float backs;     // share of its rays that hit backs by winding, averaged over frames, 0..1
    float fronts;    // the same for fronts
    uint steps;      // length of the path into the open, in clear lines from probe to probe; kNoWayOut: none
    uint nextSteps;  // the same for the next update: double-buffered
    uint trust;      // in the path: grows with every update that finds one, falls with every other, 0..kMostTrust
};

KERNEL_FN ProbeSides noSides() {
    ProbeSides sides;
    sides.backs = 0.0f;
    sides.fronts = 0.0f;
    sides.steps = 0u;
    sides.nextSteps = 0u;
    sides.trust = 0u;
    return sides;
}

KERNEL_CONST uint kNoWayOut = 255u;
// Longest valid path into the open. If a path is cut, probes beyond the cut lose theirs within this many updates.
KERNEL_CONST uint kLongestWay = 16u;
// Share of a probe's rays that must hit fronts for it to count as indoors or outdoors. It is 0 in a wall, near 0 in the
// void around a level, a half behind a curtain.
KERNEL_CONST float kFrontsInTheOpen = 0.15f;
// Share of the line to a neighbour that both must see clear. With a surface in between, one of the two sees at most
// half of it.
KERNEL_CONST float kFreeWay = 0.8f;
// Trust at which a path opens; it closes again at 0. The distances of a volume's first updates are noise, and a path
// found in them would stay open as long as they are remembered.
KERNEL_CONST uint kEnoughTrust = 12u;
KERNEL_CONST uint kMostTrust = 16u;
// If less than this share of a frame's rays hits fronts, the probe is solid at once, whatever path it had: a door moved
// over it.
KERNEL_CONST float kNoFronts = 0.03f;

// Whether a probe's share of backs is high enough that it may be inside solid matter.
KERNEL_FN bool mayBeSolid(ProbeSides sides) {
    return sides.backs > kInsideShare * (sides.backs + sides.fronts);
}

// Whether a probe sees enough fronts to be in the open if a path leads there.
KERNEL_FN bool mayBeOpen(ProbeSides sides) {
    return sides.fronts > kFrontsInTheOpen;
}

// Blends one frame into the state; `hysteresis`: share of the old values that is kept.
KERNEL_FN ProbeSides rememberSides(ProbeSides sides, SidesSeen seen, int rays, float hysteresis) {
    const float ray = 1.0f / float(rays);
    sides.backs = mix(float(seen.backs) * ray, sides.backs, hysteresis);
    sides.fronts = mix(float(seen.hits - seen.backs) * ray, sides.fronts, hysteresis);
    sides.steps = sides.nextSteps;
    return sides;
}

// Share of a frame's hits that indicate solid matter: backs of single-sided materials always do, others only if the
// probe needs a path into the open and has none. `sides` includes this frame.
KERNEL_FN float solidShare(ProbeSides sides, SidesSeen seen, int rays) {
    const bool enclosed = float(seen.hits - seen.backs) <= kNoFronts * float(rays);
    const bool lost = sides.steps == kNoWayOut || (sides.steps == 0u && mayBeSolid(sides));
    const int solid = enclosed || lost ? seen.backs : seen.solidBacks;
    return backfaceShareOf(solid, seen.hits);
}

// Whether the line between two probes is clear, from the mean distances that each stores towards the other. All
// distances in the same unit.
KERNEL_FN bool freeWay(float meanThere, float meanBack, float distance) {
    return min(meanThere, meanBack) > kFreeWay * distance;
}

// Path length via a neighbour with a clear line to it.
KERNEL_FN uint stepsBy(uint neighbourSteps) {
    return neighbourSteps < kLongestWay ? neighbourSteps + 1u : kNoWayOut;
}

// Whether a probe searches for a path: it is in doubt.
KERNEL_FN bool looksForWay(ProbeSides sides) {
    return mayBeOpen(sides) && mayBeSolid(sides);
}

// Updates trust and, if it suffices, the next update's steps. `found`: the shortest path found; used only for a probe
// that searches for one.
KERNEL_FN ProbeSides foundWay(ProbeSides sides, uint found) {
    if (!looksForWay(sides)) {
        sides.nextSteps = mayBeOpen(sides) ? 0u : kNoWayOut;
        sides.trust = 0u;
        return sides;
    }
    const bool wasOpen = sides.steps != kNoWayOut && sides.steps != 0u;
    if (found != kNoWayOut)
        sides.trust = min(sides.trust + 1u, kMostTrust);
    else
        sides.trust = sides.trust > 0u ? sides.trust - 1u : 0u;
    const bool open = wasOpen ? sides.trust > 0u : sides.trust >= kEnoughTrust;
    // While a path that was not found again is still trusted, its steps hold.
    const uint steps = found != kNoWayOut || !wasOpen ? found : sides.steps;
    sides.nextSteps = open ? steps : kNoWayOut;
    return sides;
}

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(sizeof(ProbeSides) == 20);
}  // namespace probegi::kernels
#endif

#endif
