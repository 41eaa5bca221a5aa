#include "lane.h"

#include "kernels/abi/gpu_scene.h"

void evaluate(INOUT(Lane) lane) {
    const int wrapU = takeIndex(lane, 3);
    const int wrapV = takeIndex(lane, 3);
    const bool nearest = takeIndex(lane, 2) == 1;
    const uint flags = packTextureFlags(wrapU, wrapV, nearest, takeIndex(lane, 2));
    giveBits(lane, flags);
    giveBits(lane, uint(textureWrapU(flags)));
    giveBits(lane, uint(textureWrapV(flags)));
    giveBits(lane, uint(textureNearest(flags)));
    giveBits(lane, uint(textureUvSet(flags)));

    const uint a = takeBits(lane);
    const uint b = takeBits(lane);
    const uvec2 sum = addAddress(uvec2(a, b), uvec2(takeBits(lane), 7u));
    giveBits(lane, sum.x);
    giveBits(lane, sum.y);
    for (int channel = 0; channel < 4; ++channel) giveBits(lane, texelCode(a, channel));
    giveVec3(lane, texelCodes(b), 0.0f);
}
