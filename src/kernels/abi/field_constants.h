// A field as shaders see it: the uniform block of query.glsl. One struct for C++ and GLSL, scalar layout.
#ifndef PROBEGI_KERNELS_FIELD_CONSTANTS_H
#define PROBEGI_KERNELS_FIELD_CONSTANTS_H

#include "kernels/trace/ray_set.h"
#include "kernels/volume/pool.h"
#include "kernels/volume/volume.h"

KERNELS_BEGIN

// Maximum number of volumes in a field.
KERNEL_CONST int kMostVolumes = 32;

// What a look-up asks of a probe before it reads its maps.
struct ProbeStatus {
    float backfaceShare;
    uint placement;  // kernels/volume/probe_offset.h
};

// How the volumes answer together (kernels/lookup/volume_blend.h).
struct VolumeBlending {
    vec3 camera;              // where the viewer stands, metres, in the world
    uint tracking;            // bit i: volumes[i] answers around the camera
    vec3 outsideRadiance;     // W sr^-1 m^-2, where no volume is
    int outsideFades;         // 0: there the nearest probes answer
    int order[kMostVolumes];  // of the volumes, densest first
};

struct FieldConstants {
    int volumeCount;
    int guard;             // its row in kernels/guards/list.h
    int rules;             // of the query, kRulesMeasured or kRulesPaper (kernels/lookup/probe_query.h)
    float selfShadowBias;  // FieldSettings'
    int irradianceTexels;  // side of a map without border
    int visibilityTexels;
    PoolTiles tiles;
    vec2 irradianceTexelSize;  // of the atlas, in texture coordinates
    vec2 visibilityTexelSize;
    Volume volumes[kMostVolumes];
    VolumeBlending blending;
    RaySet rays;     // of the coming update
    uvec2 masks;     // address of the words of kernels/guards/masks.h; 0: none
    int maskTexels;  // along a cell's edge
    int maskPacked;  // 1: two texels to a word
    uvec2 blockers;  // address of SdfBlocker[]; 0: none
    int blockerCount;
};

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(FieldConstants, tiles) == 24 && offsetof(FieldConstants, volumes) == 48);
static_assert(offsetof(VolumeBlending, outsideRadiance) == 16 && offsetof(VolumeBlending, order) == 32 &&
              sizeof(VolumeBlending) == 32 + 4 * kMostVolumes);
static_assert(kMostVolumes <= 32, "VolumeBlending::tracking has a bit for each");
}  // namespace probegi::kernels
#endif

#endif
