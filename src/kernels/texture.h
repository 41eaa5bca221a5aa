// Texture look-ups on mip level 0: uv transform, wrapping, bilinear filtering of decoded values. Texel (0, 0) is the
// top left one, where glTF's uv origin is.
#ifndef PROBEGI_KERNELS_TEXTURE_H
#define PROBEGI_KERNELS_TEXTURE_H

#include "kernels/language.h"

KERNELS_BEGIN

// The order of probegi::Wrap.
KERNEL_CONST int kWrapRepeat = 0;
KERNEL_CONST int kWrapClampToEdge = 1;
KERNEL_CONST int kWrapMirroredRepeat = 2;

// KHR_texture_transform: the upper two rows of its matrix on (u, v, 1). What is not finite becomes 0.
KERNEL_FN vec2 transformUv(vec3 rowU, vec3 rowV, vec2 uv) {
    vec2 at = vec2(rowU.x * uv.x + rowU.y * uv.y + rowU.z, rowV.x * uv.x + rowV.y * uv.y + rowV.z);
    if (!(abs(at.x) < 3e38f)) at.x = 0.0f;
    if (!(abs(at.y) < 3e38f)) at.y = 0.0f;
    return at;
}

// Brings a coordinate into 0..1. Indices just outside are then repeated (repeat) or clamped (the other two: the
// mirror image of the first texel is the first texel).
KERNEL_FN float foldCoordinate(float u, int wrap) {
    if (wrap == kWrapRepeat) return u - floor(u);
    if (wrap == kWrapClampToEdge) return clamp(u, 0.0f, 1.0f);
    return abs(u - 2.0f * floor(0.5f * u + 0.5f));
}

// Index of a texel that is at most one step outside 0..size-1.
KERNEL_FN int wrapTexel(int i, int size, int wrap) {
    if (wrap == kWrapRepeat) return i < 0 ? size - 1 : (i >= size ? 0 : i);
    return min(max(i, 0), size - 1);
}

// The two neighbouring texels along one axis and how far the point lies from the first to the second.
struct TexelSpan {
    int first;
    int second;
    float fraction;
};

KERNEL_FN TexelSpan texelSpan(float u, int size, int wrap, bool nearest) {
    TexelSpan span;
    const float x = foldCoordinate(u, wrap) * float(size);
    if (nearest) {
        span.first = min(int(x), size - 1);
        span.second = span.first;
        span.fraction = 0.0f;
        return span;
    }
    const float centred = x - 0.5f;
    const float lower = floor(centred);
    const int i = int(lower);
    span.first = wrapTexel(i, size, wrap);
    span.second = wrapTexel(i + 1, size, wrap);
    span.fraction = centred - lower;
    return span;
}

// Weights of the texels (first, first), (second, first), (first, second), (second, second).
KERNEL_FN vec4 bilinearWeights(float alongU, float alongV) {
    return vec4((1.0f - alongU) * (1.0f - alongV), alongU * (1.0f - alongV), (1.0f - alongU) * alongV, alongU * alongV);
}

KERNEL_FN float blendTexels(vec4 weights, float a, float b, float c, float d) {
    return weights.x * a + weights.y * b + weights.z * c + weights.w * d;
}

KERNEL_FN vec3 blendTexels(vec4 weights, vec3 a, vec3 b, vec3 c, vec3 d) {
    return weights.x * a + weights.y * b + weights.z * c + weights.w * d;
}

KERNELS_END

#endif
