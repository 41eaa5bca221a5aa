// Texels of an octahedral map one at a time: directions of centres, and which texel the border repeats.
#ifndef PROBEGI_KERNELS_OCTAHEDRAL_TEXEL_H
#define PROBEGI_KERNELS_OCTAHEDRAL_TEXEL_H

#include "kernels/octahedral.h"

KERNELS_BEGIN

// Direction of the centre of texel (x, y), 0 <= x, y < size.
KERNEL_FN vec3 octTexelDirection(int x, int y, int size) {
    const float inv = 2.0f / float(size);
    return octDecode(vec2((float(x) + 0.5f) * inv - 1.0f, (float(y) + 0.5f) * inv - 1.0f));
}

// Which interior texel the border texel (x, y) repeats, -1 <= x, y <= size; interior texels map to themselves.
// Leaving the square through an edge re-enters through the same edge, mirrored about its middle.
KERNEL_FN ivec2 octWrapTexel(int x, int y, int size) {
    ivec2 t = ivec2(x, y);
    if (t.x < 0 || t.x >= size) t = ivec2(clamp(t.x, 0, size - 1), size - 1 - t.y);
    if (t.y < 0 || t.y >= size) t = ivec2(size - 1 - t.x, clamp(t.y, 0, size - 1));
    return t;
}

KERNELS_END

#endif
