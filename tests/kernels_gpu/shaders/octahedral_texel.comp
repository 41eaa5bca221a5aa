#include "lane.h"

#include "kernels/probe/octahedral_texel.h"

void evaluate(INOUT(Lane) lane) {
    const int size = 4 + 2 * takeIndex(lane, 15);
    const int x = takeIndex(lane, size + 2) - 1;
    const int y = takeIndex(lane, size + 2) - 1;
    const ivec2 inside = octWrapTexel(x, y, size);
    giveBits(lane, uint(inside.x));
    giveBits(lane, uint(inside.y));
    for (int copy = 0; copy < 3; ++copy) {
        const ivec2 border = octBorderTexel(inside.x, inside.y, size, copy);
        giveBits(lane, uint(border.x));
        giveBits(lane, uint(border.y));
    }
    giveVec3(lane, octTexelDirection(inside.x, inside.y, size), 1e-6f);
}
