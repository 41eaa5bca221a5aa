#include "lane.h"

#include "kernels/shade/texture.h"

void giveSpan(INOUT(Lane) lane, TexelSpan s) {
    giveBits(lane, uint(s.first));
    giveBits(lane, uint(s.second));
    give(lane, s.fraction, 1e-5f);
}

// Coordinates on a grid of sixteenths of a texel, so that rounding moves none across a texel's edge.
void evaluate(INOUT(Lane) lane) {
    const vec3 rowU = takeVector(lane, -3.0f, 3.0f);
    const vec3 rowV = takeVector(lane, -3.0f, 3.0f);
    const vec2 uv = takeUnit2(lane);
    const int size = 1 << takeIndex(lane, 8);
    const float u = (float(takeIndex(lane, 64 * size) - 32 * size) + 0.5f) / float(16 * size);
    giveVec2(lane, transformUv(rowU, rowV, uv), 2e-6f);
    for (int wrap = kWrapRepeat; wrap <= kWrapMirroredRepeat; ++wrap) {
        give(lane, foldCoordinate(u, wrap), 1e-6f);
        give(lane, foldCoordinate(u * 1e20f, wrap), 1e-6f);
        giveBits(lane, uint(wrapTexel(-1, size, wrap)));
        giveBits(lane, uint(wrapTexel(size, size, wrap)));
        giveSpan(lane, texelSpan(u, size, wrap, false));
        giveSpan(lane, texelSpan(u, size, wrap, true));
        giveSpan(lane, texelSpan(0.0f, size, wrap, false));
        giveSpan(lane, texelSpan(1.0f, size, wrap, false));
    }
    const int height = 1 + takeIndex(lane, 300);
    const int level = takeIndex(lane, 9);
    giveBits(lane, uint(mipSize(height, level)));
    giveBits(lane, uint(mipLevels(size, height)));
    giveBits(lane, uint(mipOffset(size, height, level)));
    const float spread = takeBetween(lane, 1e-5f, 1e-2f);
    const float distance = takeBetween(lane, 0.0f, 1e3f);
    const float metres = coneFootprint(spread, distance, rowU.x);
    give(lane, metres, 5e-5f);
    const float uvs = uvArea(uv, vec2(rowU.x, rowV.x), vec2(rowV.y, rowU.y));
    give(lane, uvs, 2e-5f);
    give(lane, texelsPerUvArea(rowU, rowV, size, height) / float(size * height), 1e-5f);
    give(lane, footprintLevel(metres, uv.x * 1e6f, uv.y + 1e-3f, 10), 1e-4f);
    const vec4 weights = bilinearWeights(uv.x, uv.y);
    const vec3 a = takeVector(lane, 0.0f, 255.0f);
    const vec3 b = takeVector(lane, 0.0f, 255.0f);
    const vec3 c = takeVector(lane, 0.0f, 255.0f);
    const vec3 d = takeVector(lane, 0.0f, 255.0f);
    giveVec3(lane, blendTexels(weights, a, b, c, d), 1e-6f);
    give(lane, blendTexels(weights, a.x, b.x, c.x, d.x), 1e-6f);
}
