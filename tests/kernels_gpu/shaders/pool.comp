#include "lane.h"

#include "kernels/volume/pool.h"

void evaluate(INOUT(Lane) lane) {
    PoolTiles tiles;
    tiles.rowShift = takeIndex(lane, 8);
    tiles.layerShift = tiles.rowShift + takeIndex(lane, 8);
    const ivec3 tile = poolTile(tiles, takeIndex(lane, 1 << 20));
    giveBits(lane, uint(tile.x));
    giveBits(lane, uint(tile.y));
    giveBits(lane, uint(tile.z));
    const int texels = 4 + 2 * takeIndex(lane, 14);
    const ivec2 origin = tileOrigin(tile, texels);
    giveBits(lane, uint(origin.x));
    giveBits(lane, uint(origin.y));
    const float side = float((texels + 2) << 8);
    const float u = takeBetween(lane, -1.0f, float(texels));
    const float v = takeBetween(lane, -1.0f, float(texels));
    giveVec2(lane, atlasCoordinates(tile, vec2(u, v), texels, vec2(1.0f / side, 1.0f / side)), 1e-6f);
}
