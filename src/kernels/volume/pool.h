// The pool of probes of a field: slots, of which each volume owns a range. Where a slot's texels lie in the atlases of
// a GPU: an atlas is an array image of tiles, in each the octahedral map with a border of one texel all around, so that
// a hardware filter stays inside a probe's tile. Rows and layers hold powers of two of tiles: no division.
#ifndef PROBEGI_KERNELS_POOL_H
#define PROBEGI_KERNELS_POOL_H

#include "kernels/language.h"

KERNELS_BEGIN

struct PoolTiles {
    int rowShift;    // log2 of the tiles in a row
    int layerShift;  // log2 of the tiles in a layer
};

// Slot -> column, row, layer.
KERNEL_FN ivec3 poolTile(PoolTiles tiles, int slot) {
    return ivec3(slot & ((1 << tiles.rowShift) - 1), (slot & ((1 << tiles.layerShift) - 1)) >> tiles.rowShift,
                 slot >> tiles.layerShift);
}

// Tile -> texel of the atlas at which the map's texel (0, 0) lies, for maps of `texels` a side without border.
KERNEL_FN ivec2 tileOrigin(ivec3 tile, int texels) {
    return ivec2(tile.x * (texels + 2) + 1, tile.y * (texels + 2) + 1);
}

// Texture coordinates of a point of a probe's octahedral square, `texel` in texel units (octTexelPosition).
// `texelSize`: of the atlas, in texture coordinates.
KERNEL_FN vec2 atlasCoordinates(ivec3 tile, vec2 texel, int texels, vec2 texelSize) {
    const ivec2 origin = tileOrigin(tile, texels);
    return vec2((float(origin.x) + texel.x + 0.5f) * texelSize.x, (float(origin.y) + texel.y + 0.5f) * texelSize.y);
}

KERNELS_END

#endif
