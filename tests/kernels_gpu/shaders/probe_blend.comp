#include "lane.h"

#include "kernels/blend/probe_blend.h"

// The hysteresis is discontinuous at its thresholds; values are continuous, so that none is within rounding of one.
void evaluate(INOUT(Lane) lane) {
    const vec3 texel = takeDirection(lane);
    const vec3 ray = takeDirection(lane);
    const vec3 oldStored = takeVector(lane, 0.0f, 2.0f);
    const vec3 newMean = takeVector(lane, 0.0f, 30.0f);
    const float signedDistance = takeBetween(lane, -10.0f, 10.0f);
    BlendRule rule;
    rule.hysteresis = takeBetween(lane, 0.0f, 0.999f);
    rule.significantChange = takeBetween(lane, 0.0f, 0.5f);
    rule.newDistribution = takeBetween(lane, 0.0f, 1.0f);

    // Any bits, including NaN and infinity.
    const float anything = uintBitsToFloat(takeBits(lane));
    give(lane, safeRadiance(anything), 1e-6f);
    give(lane, safeDistance(anything), 1e-6f);
    giveBits(lane, hitBack(safeDistance(anything)) ? 1u : 0u);
    giveBits(lane, hitBack(signedDistance) ? 1u : 0u);
    giveBits(lane, hitBackface(signedDistance, anything) ? 1u : 0u);
    giveVec3(lane, arrivingRadiance(signedDistance, vec3(anything, ray.x, ray.y)), 1e-6f);
    giveVec3(lane, radianceFromBack(newMean), 1e-6f);
    give(lane, arrivingRadiance(-1.0f, radianceFromBack(vec3(0.0f))).x, 1e-6f);
    give(lane, backfaceShareOf(int(oldStored.x * 10.0f), int(oldStored.y * 10.0f)), 1e-6f);
    give(lane, normalisingFactor(newMean.x), 1e-6f);
    give(lane, normalisingFactor(0.0f), 0.0f);
    give(lane, withoutBackfaces(newMean.y, oldStored.z), 2e-6f);

    give(lane, irradianceWeight(texel, ray), 1e-6f);
    give(lane, visibilityWeight(texel, ray, 50.0f), 2e-5f);
    give(lane, leastVisibilityCosine(texel.x, 1.0f + 100.0f * rule.hysteresis), 2e-5f);
    give(lane, visibilityEvidence(newMean.z, 1.0f + 300.0f * rule.hysteresis, 144), 2e-6f);
    give(lane, keptMoments(rule.hysteresis, oldStored.y), 1e-6f);
    give(lane, keptMoments(0.0f, oldStored.y), 0.0f);
    give(lane, visibilityDistance(signedDistance, 3.0f), 1e-6f);
    give(lane, visibilityDistance(1e30f, 3.0f), 1e-6f);
    give(lane, texelHysteresis(oldStored, 0.5f * newMean, rule), 1e-6f);
    giveVec3(lane, blendEncoded(oldStored, newMean, rule), 2e-6f);
    giveVec3(lane, blendLinear(oldStored, newMean, rule.hysteresis), 2e-6f);
}
