#include "lane.h"

#include "kernels/probe/packed_ray.h"

void evaluate(INOUT(Lane) lane) {
    const float red = takeUnit(lane);
    const vec2 rest = takeUnit2(lane);
    const vec3 unit = vec3(red, rest.x, rest.y);
    const vec3 radiance = unit * powerOfTwo(takeIndex(lane, 30) - 14);
    const float distance = 20.0f * takeUnit(lane) - 10.0f;
    const vec3 given = unsignedRadiance(distance, distance < 0.0f ? -radiance : radiance);
    giveVec3(lane, given, 0.0f);
    give(lane, packableRadiance(-unit.x), 0.0f);
    const uint packed = packRadiance(radiance);
    giveBits(lane, packed);
    giveVec3(lane, unpackRadiance(packed), 0.0f);
    const float signedRed = takeIndex(lane, 2) == 0 ? radiance.x : -radiance.x - 1.0f;
    const float packedDistance = packRayDistance(distance, signedRed);
    giveBits(lane, floatBitsToUint(packedDistance));
    giveVec3(lane, unpackRayRadiance(packed, packedDistance), 0.0f);
}
