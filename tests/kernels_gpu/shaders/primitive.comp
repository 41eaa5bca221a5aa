#include "lane.h"

#include "some_solid.h"

// Gradients jump at the planes between faces, which random points are not on in a turned frame; each is compared by the
// point to which it leads.
void evaluate(INOUT(Lane) lane) {
    const SdfSolid solid = takeSolid(lane);
    const vec3 point = takeVector(lane, -4.0f, 4.0f);
    const float distance = sdfDistance(solid, point);
    give(lane, distance, 1e-5f);
    give(lane, sdfRounding(solid), 0.0f);
    give(lane, sdfDistance(solid, point - sdfGradient(solid, point) * distance), 1e-5f);
    give(lane, length(sdfSurfaceNormal(solid, point)), 1e-5f);
    give(lane, sdfLocalDistance(solid, point), 1e-5f);
    give(lane, dot(sdfSurfaceNormal(solid, point), sdfGradient(solid, point)) > 0.5f ? 1.0f : 0.0f, 0.0f);

    // Off the planes where the nearest face changes.
    const vec3 p = takeVector(lane, -1.4f, 1.3f) + vec3(0.0113f, 0.0237f, 0.0371f);
    const vec3 halfSize = solid.halfSize;
    const vec3 beyond = sdfBeyondFaces(halfSize, p);
    giveVec3(lane, beyond, 1e-6f);
    give(lane, sdfBoxDistance(halfSize, p), 1e-6f);
    giveVec3(lane, sdfOnSegment(halfSize.y, p), 1e-6f);
    giveVec2(lane, sdfBeyondCylinder(halfSize, p), 1e-6f);
    giveVec3(lane, sdfFaceNormal(beyond, p), 0.0f);
    giveVec3(lane, sdfBoxGradient(halfSize, p), 1e-4f);
    giveVec3(lane, sdfSideNormal(p), 1e-5f);
    giveVec3(lane, sdfEndNormal(p), 0.0f);
    giveVec3(lane, sdfCylinderGradient(halfSize, p), 1e-4f);
    giveVec3(lane, sdfLocalGradient(solid, p), 1e-4f);
}
