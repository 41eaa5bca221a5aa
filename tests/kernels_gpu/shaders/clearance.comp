#include "lane.h"

#include "some_solid.h"

#include "kernels/sdf/clearance.h"

void evaluate(INOUT(Lane) lane) {
    const SdfSolid solid = takeSolid(lane);
    const vec3 from = takeVector(lane, -2.0f, 2.0f);
    const vec3 way = takeVector(lane, -3.0f, 3.0f);
    const float share = takeBetween(lane, 0.1f, 1.0f);
    give(lane, crossing(way.x, abs(from.y), abs(way.y), share), 1e-4f);
    giveVec3(lane, scaledBy(from, share), 1e-6f);
    give(lane, distanceOverShare(solid, from, way, share), 1e-4f);
    // Beside a face the end of the way counts or not.
    const vec3 past = abs(abs(from) - solid.halfSize);
    const float edge = min(past.x, min(past.y, past.z)) < 1e-4f ? 10.0f : 1e-4f;
    give(lane, sdfBoxClearance(solid.halfSize, from, way), edge);
    give(lane, max(sdfSearchedClearance(solid, from, way), -1.0f), 2e-3f);
    give(lane, max(sdfClearance(solid, from, way), -1.0f), max(edge, 2e-3f));
    give(lane, sdfEndClearance(solid, from + way), 1e-5f);
    SdfBlocker blocker;
    blocker.solid = solid;
    blocker.reach = vec3(0.5f);
    const vec3 apart = abs(abs(from - solid.centre) - vec3(1.0f));
    if (min(apart.x, min(apart.y, apart.z)) > 1e-4f)
        give(lane, sdfIsNear(blocker, from, vec3(0.5f)) ? 1.0f : 0.0f, 0.0f);
}
