#include "lane.h"

#include "kernels/sampling.h"

void evaluate(INOUT(Lane) lane) {
    const vec3 normal = takeDirection(lane);
    const vec3 v = takeVector(lane, -2.0f, 2.0f);
    const vec2 u = takeUnit2(lane);
    const mat3 frame = orthonormalBasis(normal);
    giveVec3(lane, frame[0], 2e-6f);
    giveVec3(lane, frame[1], 2e-6f);
    giveVec3(lane, toWorld(frame, v), 1e-5f);
    giveVec3(lane, toLocal(frame, v), 1e-5f);
    giveVec2(lane, sampleDisk(u), 1e-5f);
    // The height is a square root, which near the rim amplifies the rounding of the disk.
    const vec3 onHemisphere = sampleCosineHemisphere(u);
    give(lane, onHemisphere.z * onHemisphere.z, 2e-5f);
    give(lane, pdfCosineHemisphere(normal.z), 1e-6f);
    giveVec3(lane, sampleSphere(u), 1e-5f);
    giveVec2(lane, sampleTriangle(u), 1e-6f);
    give(lane, powerHeuristic(u.x, u.y), 1e-5f);
}
