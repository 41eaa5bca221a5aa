#include "lane.h"

#include "some_solid.h"

#include "kernels/sdf/way_out.h"

// Where two faces are as near, rounding chooses: ways are compared by their lengths, and that of searched ones by where
// it leads.
void evaluate(INOUT(Lane) lane) {
    const SdfSolid solid = takeSolid(lane);
    const vec3 p = takeVector(lane, -1.0f, 1.0f);
    vec3 normal = takeDirection(lane);
    // Not where rounding decides whether a face is on the other side.
    if (abs(abs(normal.x) + kOtherSide) < 0.01f || abs(abs(normal.y) + kOtherSide) < 0.01f ||
        abs(abs(normal.z) + kOtherSide) < 0.01f)
        normal = vec3(0.0f, 1.0f, 0.0f);
    give(lane, min(abs(axisWayOut(solid.halfSize.x, p.x, normal.x)), 100.0f), 1e-5f);
    const vec3 past = abs(abs(p) - solid.halfSize);
    const float face = min(past.x, min(past.y, past.z)) < 1e-4f ? 1.0f : 1e-5f;
    give(lane, length(sdfBoxWayOut(solid.halfSize, p, normal, 0.02f)), face);
    give(lane, awayFromZero(p.x * 1e-6f), 1e-9f);
    // Thin in front of the point: entered and left far from the limits.
    give(lane, sdfBoxThrough(vec3(2.0f, 0.01f, 2.0f), vec3(p.x, -0.2f, p.z), vec3(0.1f, 0.9f, -0.1f), 0.5f), 1e-5f);
    give(lane, sdfBoxThrough(vec3(2.0f, 0.01f, 2.0f), vec3(p.x, -0.2f, p.z), vec3(0.1f, 0.9f, -0.1f), 0.1f), 0.0f);
    const vec3 searched = sdfSearchedWayOut(solid, p, vec3(0.0f), 0.02f);
    const float depth = sdfLocalDistance(solid, p);
    give(lane, length(searched), abs(depth) < 1e-4f ? 1.0f : 1e-3f);
    give(lane, length(sdfWayOutOf(solid, p, vec3(0.0f), 0.02f, 0.0f)), min(face, abs(depth)) < 1e-4f ? 2.0f : 1e-3f);
}
