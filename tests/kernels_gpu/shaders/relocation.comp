#include "lane.h"

#include "kernels/probe/relocation.h"

void evaluate(INOUT(Lane) lane) {
    const int rules = takeIndex(lane, 2);
    const vec3 spacing = takeVector(lane, 0.5f, 2.0f);
    const vec3 share = takeVector(lane, -0.45f, 0.45f);
    PlaceSight sight = nothingSeen();
    for (int i = 0; i < 6; ++i) {
        const vec3 direction = takeDirection(lane);
        const float distance = takeBetween(lane, -2.0f, 3.0f);
        const uint kind = takeBits(lane) % 4u;
        addToPlaceSight(sight, direction, kind == 3u ? 1e30f : distance, kind == 2u && distance < 0.0f);
    }
    give(lane, sight.closestBack, 1e-6f);
    give(lane, sight.closestFront, 1e-6f);
    give(lane, sight.farthestFront, 1e-6f);
    giveVec3(lane, sight.toClosestBack + sight.toClosestFront, 1e-5f);
    giveBits(lane, uint(sight.seen.hits + 8 * sight.seen.backs + 64 * sight.seen.solidBacks));
    giveBits(lane, (isInside(sight.seen, 6, rules) ? 1u : 0u) + (isOff(sight.seen, 6, rules) ? 8u : 0u) +
                       16u * looksOfPlacement(rules == 1));
    const vec3 limit = kRelocationLimit * spacing;
    const vec3 offset = share * spacing;
    giveBits(lane, isWithin(offset, limit * 0.8f) ? 1u : 0u);
    give(lane, roomAlong(offset.x, sight.toClosestBack.x, limit.x), 1e-4f);
    const vec3 moved = relocated(offset, sight, 6, spacing, min(spacing.x, min(spacing.y, spacing.z)), rules);
    giveBits(lane, isWithin(moved, limit * 1.01f) ? 1u : 0u);
    // Steps of a hundredth may round apart.
    giveVec3(lane, moved, 0.03f);
    giveVec3(lane, movedThroughBack(offset, sight.closestFront * sight.toClosestFront, limit), 0.05f);
}
