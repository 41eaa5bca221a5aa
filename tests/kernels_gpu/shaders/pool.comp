#include "lane.h"

#include "kernels/volume/pool.h"

void evaluate(INOUT(Lane) lane) {
    PoolTiles tiles;
    tiles.rowShift = takeIndex(lane, 7);
    tiles.layerShift = tiles.rowShift + takeIndex(lane, 7);
    const ivec3 tile = poolTile(tiles, takeIndex(lane, 1 << 20));
    giveBits(lane, uint(tile.x));
    giveBits(lane, uint(tile.y));
    giveBits(lane, uint(tile.z));
    const int texels = 4 + 2 * takeIndex(lane, 14);
    const ivec2 origin = tileOrigin(tile, texels);
    giveBits(lane, uint(origin.x));
    giveBits(lane, uint(origin.y));
    const float side = float((1 << tiles.rowShift) * (texels + 2));
    const float u = takeBetween(lane, -1.0f, float(texels));
    const float v = takeBetween(lane, -1.0f, float(texels));
    const vec2 at = atlasCoordinates(tile, vec2(u, v), texels, vec2(1.0f / side, 1.0f / side));
    give(lane, at.x, 1e-6f);
    give(lane, at.y, 1e-6f);
}
