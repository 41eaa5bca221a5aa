// Whether a probe stands inside solid matter. The paper asks for the share of backfaces among what a probe's rays hit
// (section 4.1, Listing 4), and a surface whose material has two sides has no backface. But whether a probe stands in a
// wall follows from geometry: the side that a ray meets is told by the winding, whatever the material. Where most of
// what a probe sees are backs, it stands in a wall or in the void beyond a level's hull, or behind a sheet that is
// open at its edges: a curtain, leaves. The latter has fronts in view too, and a free line to a probe in the open, or
// to one that has such a line.
#ifndef PROBEGI_KERNELS_SOLID_PROBE_H
#define PROBEGI_KERNELS_SOLID_PROBE_H

#include "kernels/blend/probe_blend.h"
#include "kernels/lookup/probe_query.h"

KERNELS_BEGIN

// What the rays of a probe met in one frame.
struct SidesSeen {
    int hits;        // of any surface
    int backs;       // of them: on backs by winding, whatever the material
    int solidBacks;  // of them: on backs of single-sided materials
};

// The same of up to 1,023 rays in 32 bits; one ray's packed sides add up to those of many.
KERNEL_FN uint packSides(bool hit, bool back, bool solidBack) {
    return (hit ? 1u : 0u) + (back ? 0x400u : 0u) + (solidBack ? 0x100000u : 0u);
}
KERNEL_FN SidesSeen addSides(SidesSeen seen, uint packed) {
    seen.hits += int(packed & 0x3ffu);
    seen.backs += int((packed >> 10u) & 0x3ffu);
    seen.solidBacks += int(packed >> 20u);
    return seen;
}

// What a probe remembers of it from frame to frame.
struct ProbeSides {
    float backs;     // share of its rays that met backs by winding, averaged over frames, 0..1
    float fronts;    // the same of fronts
    uint steps;      // free lines from probe to probe that lead into the open; kNoWayOut: none
    uint nextSteps;  // the same for the coming update: all probes are looked at before one changes
    uint trust;      // in the way: grows with every update that finds one and falls with every other, 0..kMostTrust
};

KERNEL_CONST uint kNoWayOut = 255u;
// Longest way into the open that counts. Where a way is cut, probes beyond the cut lose theirs within so many updates.
KERNEL_CONST uint kLongestWay = 16u;
// Share of a probe's rays that must meet fronts before it counts as a place in a room or out of doors. In a wall it is
// 0, in the void around a level near it; behind a curtain it is a half.
KERNEL_CONST float kFrontsInTheOpen = 0.15f;
// Share of the way to a neighbour that both must see free. Where a surface is between, one of the two sees half of it
// at most.
KERNEL_CONST float kFreeWay = 0.8f;
// Trust at which a way opens; it closes again at 0. The distances of a volume's first updates are noise, and a way
// through them would stay open for as long as they are remembered.
KERNEL_CONST uint kEnoughTrust = 12u;
KERNEL_CONST uint kMostTrust = 16u;
// Share of a frame's rays on fronts below which a probe is in solid matter at once, whatever way it had: a door that
// moved over it.
KERNEL_CONST float kNoFronts = 0.03f;

// Whether so much of what a probe hits are backs that it may stand in solid matter.
KERNEL_FN bool mayBeSolid(ProbeSides sides) {
    return sides.backs > kInsideShare * (sides.backs + sides.fronts);
}

// Whether a probe sees enough fronts to be in the open, should a way lead there.
KERNEL_FN bool mayBeOpen(ProbeSides sides) {
    return sides.fronts > kFrontsInTheOpen;
}

// One frame joins what is remembered; `hysteresis`: share of the old values that survives.
KERNEL_FN ProbeSides rememberSides(ProbeSides sides, SidesSeen seen, int rays, float hysteresis) {
    const float ray = 1.0f / float(rays);
    sides.backs = mix(float(seen.backs) * ray, sides.backs, hysteresis);
    sides.fronts = mix(float(seen.hits - seen.backs) * ray, sides.fronts, hysteresis);
    sides.steps = sides.nextSteps;
    return sides;
}

// Share of a frame's hits that speaks for solid matter: backs of single-sided materials always do, those of others
// where the probe needs a way into the open and has none. `sides`: with this frame.
KERNEL_FN float solidShare(ProbeSides sides, SidesSeen seen, int rays) {
    const bool enclosed = float(seen.hits - seen.backs) <= kNoFronts * float(rays);
    const bool lost = sides.steps == kNoWayOut || (sides.steps == 0u && mayBeSolid(sides));
    const int solid = enclosed || lost ? seen.backs : seen.solidBacks;
    return backfaceShareOf(solid, seen.hits);
}

// Whether nothing stands between two probes, from the mean distances that each stores towards the other. All distances
// in one unit.
KERNEL_FN bool freeWay(float meanThere, float meanBack, float distance) {
    return min(meanThere, meanBack) > kFreeWay * distance;
}

// Steps by way of a neighbour to which the way is free.
KERNEL_FN uint stepsBy(uint neighbourSteps) {
    return neighbourSteps < kLongestWay ? neighbourSteps + 1u : kNoWayOut;
}

// Whether a probe looks for a way: it is in doubt.
KERNEL_FN bool looksForWay(ProbeSides sides) {
    return mayBeOpen(sides) && mayBeSolid(sides);
}

// What an update found becomes the coming one's steps, should the way be trusted. `found`: the fewest steps of all
// ways; counts only for a probe that looks for one.
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
    // While there is trust in a way that was not found again, its steps hold.
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
