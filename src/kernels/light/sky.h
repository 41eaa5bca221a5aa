// Look-ups in an equirectangular sky: -Z in the centre column, +Y in the top row.
#ifndef PROBEGI_KERNELS_SKY_H
#define PROBEGI_KERNELS_SKY_H

#include "kernels/language.h"

KERNELS_BEGIN

// Image coordinates of a unit direction, 0..1; u = 1/2 is -Z and grows towards +X. The polar angle uses an
// arc tangent, since near the poles an arc cosine loses half its digits.
KERNEL_FN vec2 skyUv(vec3 direction) {
    const float level = sqrt(direction.x * direction.x + direction.z * direction.z);
    const float u = level > 0.0f ? atan(direction.x, -direction.z) / (2.0f * kPi) + 0.5f : 0.5f;
    return vec2(u, atan(level, direction.y) / kPi);
}

// The four texels of a bilinear look-up, which wraps around horizontally, and the weights of the right and lower ones.
struct SkyTexels {
    int left;
    int right;
    int upper;
    int lower;
    float alongX;
    float alongY;
};

// Always inside the image, for any uv.
KERNEL_FN SkyTexels skyTexels(vec2 uv, int width, int height) {
    const float x = uv.x * float(width) - 0.5f;
    const float y = clamp(uv.y * float(height) - 0.5f, 0.0f, float(height - 1));
    const int column = min(max(int(floor(x)), -1), width - 1);
    const int row = min(max(int(y), 0), height - 1);
    SkyTexels t;
    t.left = (column + width) % width;
    t.right = (column + 1) % width;
    t.upper = row;
    t.lower = min(row + 1, height - 1);
    t.alongX = x - float(column);
    t.alongY = y - float(row);
    return t;
}

KERNEL_FN vec3 blendSky(SkyTexels t, vec3 upperLeft, vec3 upperRight, vec3 lowerLeft, vec3 lowerRight) {
    return mix(mix(upperLeft, upperRight, t.alongX), mix(lowerLeft, lowerRight, t.alongX), t.alongY);
}

KERNELS_END

#endif
