#include "lane.h"

#include "kernels/probe/probe_texel.h"

// Dithered rounding can turn a difference in the last bit into a step of the storage format, so blends are compared to
// a step, but bit for bit if nothing is rounded before the dither.
void evaluate(INOUT(Lane) lane) {
    const vec3 oldStored = takeVector(lane, 0.0f, 2.0f);
    const vec3 newMean = takeVector(lane, 0.0f, 30.0f);
    const vec2 newMoments = takeUnit2(lane);
    const uint oldMoments = takeBits(lane);
    const uint half_ = takeBits(lane) & 0x7bffu;
    const uint seed = takeBits(lane);
    const uint texel = takeBits(lane);
    BlendRule rule;
    rule.hysteresis = takeBetween(lane, 0.0f, 0.999f);
    rule.significantChange = takeBetween(lane, 0.0f, 0.5f);
    rule.newDistribution = takeBetween(lane, 0.0f, 1.0f);

    for (int space = 0; space < 2; ++space) {
        const uvec3 bits = blendIrradianceTexel(oldStored, newMean, rule, space == 1, seed, texel);
        giveVec3(lane, vec3(unpackHalf(bits.x), unpackHalf(bits.y), unpackHalf(bits.z)), 1.0f / 1000.0f);
    }
    giveVec2(lane, unpackMoments(blendVisibilityTexel(oldMoments, newMoments, rule.hysteresis, seed, texel)), 1.6e-5f);
    giveVec2(lane, unpackMoments(oldMoments), 1e-6f);
    giveBits(lane, packMoments(unpackMoments(oldMoments)));

    rule.hysteresis = 1.0f;
    rule.significantChange = 0.0f;
    rule.newDistribution = 0.0f;
    const uint normalHalf = max(half_, 0x400u);
    const uvec3 kept = blendIrradianceTexel(vec3(unpackHalf(normalHalf)), newMean, rule, false, seed, texel);
    giveBits(lane, kept.x);
    giveBits(lane, kept.z);
}
