#include "lane.h"

#include "kernels/probe/solid_probe.h"

void evaluate(INOUT(Lane) lane) {
    ProbeSides sides;
    sides.backs = takeUnit(lane);
    sides.fronts = takeUnit(lane);
    // 0, a few steps, none.
    const uint steps = takeBits(lane) % 20u;
    sides.steps = steps == 19u ? kNoWayOut : steps;
    sides.nextSteps = takeBits(lane) % 16u;
    sides.trust = takeBits(lane) % (kMostTrust + 1u);
    const uint found = takeBits(lane) % 18u;
    const uint rays = takeBits(lane);
    const float hysteresis = takeBetween(lane, 0.0f, 0.999f);

    SidesSeen seen;
    seen.hits = seen.backs = seen.solidBacks = 0;
    for (uint i = 0u; i < 4u; ++i) {
        const uint ray = rays >> (3u * i);
        seen = addSides(seen, packSides((ray & 1u) != 0u, (ray & 3u) == 3u, (ray & 7u) == 7u));
    }
    giveBits(lane, uint(seen.hits));
    giveBits(lane, uint(seen.backs));
    giveBits(lane, uint(seen.solidBacks));
    const ProbeSides remembered = rememberSides(sides, seen, 4, hysteresis);
    give(lane, remembered.backs, 1e-6f);
    give(lane, remembered.fronts, 1e-6f);
    giveBits(lane, remembered.steps);
    give(lane, solidShare(sides, seen, 4), 1e-6f);
    giveBits(lane, (mayBeSolid(sides) ? 1u : 0u) + (mayBeOpen(sides) ? 2u : 0u) + (looksForWay(sides) ? 4u : 0u));
    giveBits(lane, freeWay(sides.backs, sides.fronts, hysteresis) ? 1u : 0u);
    giveBits(lane, stepsBy(found));
    const ProbeSides next = foundWay(sides, found == 17u ? kNoWayOut : found);
    giveBits(lane, next.nextSteps);
    giveBits(lane, next.trust);
    giveBits(lane, stepsBy(noSides().steps) + noSides().nextSteps + noSides().trust);
}
