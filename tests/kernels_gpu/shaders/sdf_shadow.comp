#include "lane.h"

#include "lookup_access.h"
#include "some_cage.h"

#include "kernels/guards/sdf_shadow.h"

void evaluate(INOUT(Lane) lane) {
    const Volume v = takeVolume(lane);
    const Access access = accessTo(kRulesMeasured, 3, 0.0f);
    const vec3 fromProbe = takeVector(lane, -1.0f, 1.0f);
    const Cage cage = takeCage(lane, v);
    const CageSlots slots = cageSlots(v, cage.base);
    const ShadowWays ways = waysToProbes(access, v, cage, slots, vec3(0.25f));
    for (int corner = 0; corner < 8; ++corner) giveVec3(lane, ways.to[corner], 1e-4f);
    // Points within a solid may leave it by another face where two are as near, and where one begins inside, all ways
    // are blocked: what is compared are points away from all of them.
    bool apart = true;
    for (int i = 0; i < access.blockers; ++i) {
        const SdfSolid solid = blockerAt(access, i).solid;
        const vec3 own = sdfToLocal(solid, cage.position - solid.centre);
        apart = apart && sdfLocalDistance(solid, own) > 0.2f * v.minSpacing;
    }
    if (apart) {
        giveVec3(lane, shadowBegin(access, cage.position, cage.normal, v.minSpacing), 1e-4f);
        giveVec3(lane, sdfShadowBegin(access, v, cage), 1e-4f);
        const GuardPoint point = sdfShadowPoint(access, v, cage, slots);
        for (int corner = 0; corner < 8; ++corner) give(lane, point.seen[corner], 0.05f);
    }
    GuardPoint some = noGuardPoint();
    some.scale = 1.0f;
    some.seen[3] = 0.25f;
    give(lane, sdfShadowSeen(access, v, 5, 3, fromProbe, some), 0.0f);
    give(lane, shareSeen(fromProbe.x, 0.2f), 1e-5f);
    ShadowBalls balls;
    for (int corner = 0; corner < 8; ++corner) {
        balls.seen[corner] = fromProbe.y;
        balls.whole[corner] = 0.1f * float(corner + 1);
    }
    give(lane, noteOf(balls).seen[6], 1e-5f);
    // Where a ball just fits, rounding of its radius counts.
    give(lane, shadowAlong(access, cage.position, fromProbe, 0.1f), 0.05f);
    give(lane, sdfShadowBetween(access, v, 5, 3, axisPoint(access, v, 1, true), 1.0f, cage.position), 0.05f);
    give(lane, sdfShadowFar(access, v, 5, fromProbe, cage.position), 0.05f);
    float whole = 0.3f;
    float seen = 0.2f;
    SdfSolid post = blockerAt(access, 0).solid;
    shadeBall(post, vec3(0.5f), fromProbe, whole, seen);
    give(lane, whole, 1e-5f);
    give(lane, max(seen, 0.0f), 1e-3f);
}
