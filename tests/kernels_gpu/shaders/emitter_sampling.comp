#include "lane.h"

#include "kernels/light/emitter_sampling.h"

// Choices are integers: exact on both sides.
void evaluate(INOUT(Lane) lane) {
    const uint frame = takeBits(lane);
    const uint probe = takeBits(lane);
    const uint looks = 1u + uint(takeIndex(lane, 16));
    const uint index = uint(takeIndex(lane, int(looks)));
    const vec3 origin = takeVector(lane, -3.0f, 3.0f);
    const vec3 corner = takeVector(lane, -3.0f, 3.0f);
    const vec3 edge1 = takeDirection(lane);
    const vec3 edge2 = takeDirection(lane);
    const float perArea = takeBetween(lane, 1e-3f, 100.0f);
    const int rays = 8 + takeIndex(lane, 4089);

    const uint seed = emitterSeed(frame, probe);
    const uint choice = emitterChoice(seed, index, looks);
    giveBits(lane, seed);
    giveBits(lane, choice);
    giveVec2(lane, emitterBarycentric(seed, index, choice, choice / 3u, choice / 3u * 2u + 5u + choice / 2u), 1e-6f);
    giveVec2(lane, emitterBarycentric(seed, index, choice, choice, choice), 1e-6f);

    const EmitterAim aim = aimAtEmitter(origin, corner, edge1, edge2, vec2(0.25f, 0.5f));
    giveVec3(lane, aim.direction, 1e-4f);
    give(lane, aim.distance, 1e-5f);
    const EmitterAim at = aimAtEmitter(origin, origin, vec3(0.0f), vec3(0.0f), vec2(0.25f, 0.5f));
    give(lane, at.distance, 0.0f);
    give(lane, at.cosine, 0.0f);
    // With almost parallel edges the normal is too inexact, so the cosine is set directly.
    EmitterAim fixedAim;
    fixedAim.direction = edge1;
    fixedAim.distance = length(corner - origin);
    fixedAim.cosine = 0.5f + 0.5f * edge2.x * edge2.x;
    give(lane, emitterTolerance(fixedAim, 1e-5f), 1e-8f);
    give(lane, rayDensity(rays), 1e-4f);
    give(lane, lookDensity(int(looks), perArea, fixedAim.distance), 0.2f);
    give(lane, emissionShare(perArea, 1.0f), 1e-5f);
    give(lane, emissionShare(0.0f, 1.0f), 1e-6f);
    give(lane, rayEmissionShare(rays, int(looks), perArea, fixedAim.distance), 2e-5f);
    give(lane, emitterLightFactor(rays, int(looks), perArea, fixedAim) * rayDensity(rays), 2e-5f);
}
