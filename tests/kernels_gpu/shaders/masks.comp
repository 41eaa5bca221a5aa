#include "lane.h"

#include "lookup_access.h"
#include "some_cage.h"

#include "kernels/guards/masks.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const Access access = accessTo(kRulesMeasured, 2, 0.0f);
    const vec3 fromProbe = takeVector(lane, -1.0f, 1.0f);
    const int cube = takeIndex(lane, 1000);
    const vec3 texel = takeVector(lane, 0.0f, 4.0f);
    const float high = takeUnit(lane);
    giveBits(lane, uint(maskCluster(cube)));
    giveBits(lane, uint(spreadBits(cube & 15)));
    // Weights are rounded to 1/120: two eighths of a texel may fall on either side.
    const GuardPoint point = maskPointAt(access, cube, texel);
    for (int cluster = 0; cluster < 8; ++cluster) give(lane, maskOf(point, cluster), 0.02f);
    const Cage cage = takeCage(lane, v);
    const GuardPoint there = masksPoint(access, v, cage, cageSlots(v, cage.base));
    for (int cluster = 0; cluster < 8; ++cluster) give(lane, maskOf(there, cluster), 0.02f);
    giveBits(lane, uint(maskTexel(access, cube, 3)));
    give(lane, sideFactor(high, cube & 1), 1e-6f);
    float places = 0.25f;
    float weights = 0.5f;
    addWall(cube, 4, high, places, weights);
    give(lane, places, 1e-6f);
    give(lane, weights, 1e-6f);
    // Far from the wall, where rounding could choose another side.
    give(lane, onItsSide(high * 0.3f, 0.4f, high + 0.5f), 0.0f);
    give(lane, onItsSide(0.9f, 0.1f * high, high), 0.0f);
    give(lane, onItsSide(high, 0.0f, 0.01f), 0.0f);
    GuardPoint some = noGuardPoint();
    some.low = 0x10203040;
    some.high = 0x01700078;
    some.scale = 0.01f;
    give(lane, masksSeen(access, v, 5, 1, fromProbe, some), 1e-6f);
    give(lane, masksSeen(access, v, 5, 1, fromProbe, noGuardPoint()), 5e-4f);
    give(lane, masksBetween(access, v, 5, 3, axisPoint(access, v, 1, true), 1.0f, fromProbe), 0.0f);
    if (abs(length(fromProbe) * v.inverseMaxDistance - 1.0f) < 1e-3f)
        give(lane, 0.0f, 0.0f);
    else
        give(lane, masksFar(access, v, 5, fromProbe, vec3(0.0f)), 5e-4f);
    giveVec3(lane, masksBegin(access, v, cage), 0.0f);
    giveBits(lane, uint(shiftedRight(-1 - cube, cube & 31)));
}
