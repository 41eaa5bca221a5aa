#include "lane.h"

#include "kernels/volume/gpu_volume.h"

void evaluate(INOUT(Lane) lane) {
    const int x = 2 + takeIndex(lane, 40);
    const int y = 2 + takeIndex(lane, 40);
    const int z = 2 + takeIndex(lane, 40);
    const ivec3 cell = gpuProbeCell(takeIndex(lane, x * y * z - 1), ivec3(x, y, z));
    giveBits(lane, uint(cell.x));
    giveBits(lane, uint(cell.y));
    giveBits(lane, uint(cell.z));
    const int texels = 4 + 2 * takeIndex(lane, 14);
    const ivec2 tile = gpuTileOrigin(cell, texels);
    giveBits(lane, uint(tile.x));
    giveBits(lane, uint(tile.y));
    const vec2 size = vec2(1.0f / float(x * (texels + 2)), 1.0f / float(y * (texels + 2)));
    const float u = takeBetween(lane, -1.0f, float(texels));
    const float v = takeBetween(lane, -1.0f, float(texels));
    const vec2 at = gpuAtlasCoordinates(cell, vec2(u, v), texels, size);
    give(lane, at.x, 1e-6f);
    give(lane, at.y, 1e-6f);
}
