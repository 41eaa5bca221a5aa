// What shaders know of a volume of probes (one struct for C++ and GLSL, scalar layout), and where a probe's texels lie
// in the atlases. An atlas is an array image: one layer for each z, in it a tile for each (x, y), in it the octahedral
// map with a border of one texel all around, so that a hardware filter stays inside a probe's tile.
#ifndef PROBEGI_KERNELS_GPU_VOLUME_H
#define PROBEGI_KERNELS_GPU_VOLUME_H

#include "kernels/language.h"

KERNELS_BEGIN

struct GpuVolume {
    vec3 origin;           // metres
    float minSpacing;      // metres
    vec3 spacing;          // metres
    float selfShadowBias;  // FieldDesc's
    vec3 inverseSpacing;
    float inverseMaxDistance;
    ivec3 counts;
    int guard;                 // kernels/guards/list.h
    vec2 irradianceTexelSize;  // of the atlas, in texture coordinates
    vec2 visibilityTexelSize;
    int irradianceTexels;  // side of a map without border
    int visibilityTexels;
    int rules;  // of the query, kRulesMeasured or kRulesPaper (kernels/lookup/probe_query.h)
};

// Probe number -> its place in the grid, as probegi::probePosition counts.
KERNEL_FN ivec3 gpuProbeCell(int probe, ivec3 counts) {
    return ivec3(probe % counts.x, probe / counts.x % counts.y, probe / (counts.x * counts.y));
}

// Place in the grid -> texel of the atlas at which the map's texel (0, 0) lies; the layer is cell.z.
KERNEL_FN ivec2 gpuTileOrigin(ivec3 cell, int texels) {
    return ivec2(cell.x * (texels + 2) + 1, cell.y * (texels + 2) + 1);
}

// Texture coordinates of a point of a probe's octahedral square, `texel` in texel units (octTexelPosition).
KERNEL_FN vec2 gpuAtlasCoordinates(ivec3 cell, vec2 texel, int texels, vec2 texelSize) {
    const ivec2 tile = gpuTileOrigin(cell, texels);
    return vec2((float(tile.x) + texel.x + 0.5f) * texelSize.x, (float(tile.y) + texel.y + 0.5f) * texelSize.y);
}

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(GpuVolume, spacing) == 16 && offsetof(GpuVolume, inverseSpacing) == 32);
static_assert(offsetof(GpuVolume, counts) == 48 && offsetof(GpuVolume, irradianceTexelSize) == 64);
static_assert(offsetof(GpuVolume, irradianceTexels) == 80 && sizeof(GpuVolume) == 92);
}  // namespace probegi::kernels
#endif

#endif
