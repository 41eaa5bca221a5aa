#include "lane.h"

#include "some_solid.h"

#include "kernels/sdf/distance.h"

void evaluate(INOUT(Lane) lane) {
    SdfSolid solid = takeSolid(lane);
    const vec3 p = takeVector(lane, -1.4f, 1.3f);
    giveVec3(lane, sdfToLocal(solid, p), 1e-5f);
    giveVec3(lane, sdfToWorld(solid, p), 1e-5f);
    solid.rotation = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    giveVec3(lane, sdfToLocal(solid, p), 0.0f);
    giveVec3(lane, sdfToWorld(solid, p), 0.0f);
    give(lane, sdfLocalDistance(solid, p), 1e-5f);
    giveVec3(lane, sdfBeyondFaces(solid.halfSize, p), 1e-6f);
    give(lane, sdfBoxDistance(solid.halfSize, p), 1e-6f);
    giveVec3(lane, sdfOnSegment(solid.halfSize.y, p), 1e-6f);
    give(lane, sdfFromAxis(p), 1e-6f);
    giveVec2(lane, sdfBeyondCylinder(solid.halfSize, p), 1e-6f);
    give(lane, sdfCylinderDistance(solid.halfSize, p), 1e-6f);
}
