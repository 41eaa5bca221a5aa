// Single texels of an octahedral map: directions of their centres, and which texels the border repeats.
#ifndef PROBEGI_KERNELS_OCTAHEDRAL_TEXEL_H
#define PROBEGI_KERNELS_OCTAHEDRAL_TEXEL_H

#include "kernels/probe/octahedral.h"

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

// The inverse: the `copy`-th border texel (0, 1 or 2) that repeats the interior texel (x, y), or (x, y) itself if there
// are fewer. Copies 0 and 1 lie along the two pairs of edges, copy 2 in the corner.
KERNEL_FN ivec2 octBorderTexel(int x, int y, int size, int copy) {
    const int last = size - 1;
    const bool onX = x == 0 || x == last;
    const bool onY = y == 0 || y == last;
    const int outX = x == 0 ? -1 : size;
    const int outY = y == 0 ? -1 : size;
    if (copy == 0 && onX) return ivec2(outX, last - y);
    if (copy == 1 && onY) return ivec2(last - x, outY);
    if (copy == 2 && onX && onY) return ivec2(x == 0 ? size : -1, y == 0 ? size : -1);
    return ivec2(x, y);
}

KERNELS_END

#endif
