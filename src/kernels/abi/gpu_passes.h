// Push constants of the compute passes: one struct for C++ and GLSL, scalar layout, at most 128 bytes. Buffers are
// passed as device addresses, low word first.
#ifndef PROBEGI_KERNELS_GPU_PASSES_H
#define PROBEGI_KERNELS_GPU_PASSES_H

#include "kernels/abi/dispatch.h"
#include "kernels/abi/gpu_scene.h"
#include "kernels/blend/event_region.h"
#include "kernels/blend/temporal_filter.h"
#include "kernels/screen/pinhole.h"

KERNELS_BEGIN

// What the C++ half of a tracer tells its GLSL half: buffers' addresses and numbers that nobody else reads.
struct TracerBlock {
    uvec2 addresses[6];
    uint numbers[4];
};

// The uniform buffer of a scene. Lights and sky of `scene` are unset: each pass brings its own.
struct SceneConstants {
    SceneAddresses scene;
    TracerBlock tracer;
};

// Punctual lights and sky, in a buffer of their own.
struct LightingBlock {
    uvec2 lights;     // GpuLight[lightCount]
    uvec2 skyPixels;  // vec3[]
    GpuSky sky;
    int lightCount;
};

// One entry of the sparse visibility weights: a ray and its weight for a texel.
struct GpuRayWeight {
    uint ray;
    float weight;
};

// The entries of one texel.
struct GpuTexelRays {
    uint count;      // entries
    float evidence;  // visibilityEvidence(); 1 with the paper's rules
};

// The list of all probes (all_tasks.comp), and the work that a list is (count_tasks.comp).
struct TasksPush {
    uvec2 tasks;            // GpuTaskCounts, ProbeTask[]
    uint count;             // all_tasks: of probes
    uint rays;              // a task, fixed ones included
    uint looks;             // at emitters, a task
    uint irradianceTexels;  // of a map, all
};

// Weights of a frame's rays for the texels of a probe (blend_weights.comp).
struct WeightsPush {
    uvec2 directions;         // vec3[rays]
    uvec2 irradianceWeights;  // float[ray][texel]
    uvec2 visibilityRays;     // GpuTexelRays[texel]
    uvec2 visibilityWeights;  // GpuRayWeight[entry][texel], in the order of rays
    int rays;
    int irradianceTexels;  // per map, total
    int visibilityTexels;
    int irradianceSize;  // side of a map
    int visibilitySize;
    float visibilityExponent;
    int rules;
};

// Per-probe data that the passes of one update share (kernels/blend/temporal_filter.h).
struct GpuProbeStep {
    ProbeSight sight;
    ProbeLag lag;
    float lagShare;        // of its irradiance, relative
    float irradianceKept;  // share of the old values that is kept
    float visibilityKept;
    float ownLag;  // kernels/blend/temporal_filter.h
};

// The passes around a blend with windows (probe_lag.comp, probe_windows.comp, probe_filter.comp).
struct FilterPush {
    uvec2 tasks;       // GpuTaskCounts, ProbeTask[]
    uvec2 steps;       // GpuProbeStep[slot]; no lag where a probe is no task
    uvec2 filters;     // PackedProbeFilter[slot]
    uvec2 changes;     // TexelChange[block of texels][task]
    uvec2 rayData;     // FixedRayDatum[task][ray] or, ownRays, RayDatum[task][ray]
    uvec2 directions;  // vec3[ray]
    int rays;
    int ownRays;          // not 0: there are no fixed rays, the update's own must do; kOwnRaysPacked: PackedRayDatum
    int texels;           // of an irradiance map, all
    float longestWindow;  // updates; forget: the windows
    float longestVisibilityWindow;
    uint ditherSeed;
    int forget;      // 1: probe_filter.comp only writes forgottenFilter()
    int settles;     // 1: probes and windows stay as they are (UpdateFrame::settles)
    uvec2 progress;  // out: ProbeProgress[slot] of the tasks, for a schedule; 0: nobody asks
};
KERNEL_CONST int kOwnRaysPacked = 2;

// Less of the old values where changes were announced (probe_events.comp): after probe_windows.comp, or in its place
// where there are no windows.
struct EventPush {
    uvec2 tasks;    // GpuTaskCounts, ProbeTask[]
    uvec2 steps;    // GpuProbeStep[slot]
    uvec2 filters;  // PackedProbeFilter[slot]
    uvec2 regions;  // EventRegion[count]
    int count;
    int windows;                 // 1: steps and filters have windows
    float irradianceHysteresis;  // without windows: of probes outside
    float visibilityHysteresis;
    uvec2 limits;  // EventLimit[slot], besides the regions; 0: none
};

// Both blends (blend_irradiance.comp, blend_visibility.comp).
struct BlendPush {
    uvec2 tasks;              // GpuTaskCounts, ProbeTask[]
    uvec2 rayData;            // RayDatum[task][ray] or, packedRays, PackedRayDatum[task][ray]
    uvec2 sides;              // ProbeSides[slot]
    uvec2 irradianceWeights;  // as WeightsPush
    uvec2 visibilityRays;
    uvec2 visibilityWeights;
    int rays;
    float irradianceHysteresis;  // alpha of eq. 1
    float visibilityHysteresis;
    float significantChange;  // Listing 3
    float newDistribution;    // Listing 3
    uint ditherSeed;
    int linear;           // 1: blendLinear
    uvec2 emitterLights;  // EmitterLight[task][look]
    int looks;            // at emitters, a probe; 0: none
    uvec2 steps;          // GpuProbeStep[slot]: each with its own hysteresis; 0: all with the above
    uvec2 changes;        // out, where there are steps: TexelChange[block of texels][task]
    uvec2 filters;        // PackedProbeFilter[slot]
    int packedRays;       // 1: rayData are packed
};

// What probes have that entered a volume (enter_volume.comp).
struct EnterPush {
    uvec2 sides;     // ProbeSides[slot]
    uvec2 filters;   // PackedProbeFilter[slot]
    uvec2 surfaces;  // as PlacesPush
    int volume;
    ivec3 cells;  // by which it was scrolled
};

// A probe's placement, and whether it forgets what it knows (set_placements.comp).
struct GpuPlacement {
    uint word;  // kernels/volume/probe_offset.h
    uint renewed;
};
struct PlacementsPush {
    uvec2 placements;  // GpuPlacement[slot]
    uvec2 sides;       // ProbeSides[slot]
    uvec2 filters;     // PackedProbeFilter[slot]
    uint count;        // of slots
};

// Relocation and states of recorded updates, which the CPU does not see (place_probes.comp, look_around.comp,
// step_states.comp, list_tasks.comp).
struct GpuBounds {
    vec3 lower;
    vec3 upper;
};
struct PlacesPush {
    uvec2 surfaces;  // uint[slot]: a static surface uses the probe
    uvec2 boxes;     // GpuBounds[moving + media]
    uvec2 sides;     // ProbeSides[slot]
    uvec2 filters;   // PackedProbeFilter[slot]
    uvec2 tasks;     // GpuTaskCounts, ProbeTask[]
    uvec2 chosen;    // uint[listed]: slots; 0: all of them
    uvec2 rayData;   // RayDatum[task][ray] of the caller's rays
    uvec2 directions;
    uint slots;
    uint listed;  // chosen ones, or all
    uint moving;
    uint media;
    int rays;        // of the caller, a task
    int flags;       // kPlacesRelocate, kPlacesSleep, kPlacesPackedRays: rayData are PackedRayDatum
    uvec2 progress;  // out: ProbeProgress[slot], for a schedule that does not know who sleeps; 0: nobody asks
};
KERNEL_CONST int kPlacesRelocate = 1;
KERNEL_CONST int kPlacesSleep = 2;
KERNEL_CONST int kPlacesPackedRays = 4;

// Paths into the open (find_solid_probes.comp).
struct SolidPush {
    uvec2 tasks;  // GpuTaskCounts, ProbeTask[]
    uvec2 sides;  // ProbeSides[slot]
};

// Probe rays (trace_probes.comp), their shading (shade_probes.comp), and emitter samples (look_at_emitters.comp).
struct TracePush {
    uvec2 tasks;          // GpuTaskCounts, ProbeTask[]
    uvec2 directions;     // vec3[rays]
    uvec2 hits;           // Hit[ray][task]
    uvec2 rayData;        // RayDatum[task][ray]
    uvec2 lighting;       // LightingBlock
    uvec2 fixedRays;      // FixedRayDatum[task][ray]
    int rays;             // that are blended
    int fixedRayCount;    // that come after them in directions and hits
    int bounces;          // 1: the probes hold light of an earlier update
    int looks;            // at emitters, a probe; 0: none
    uvec2 emitterLights;  // EmitterLight[task][look]
    uint emitterSeed;     // of the frame
};

// Irradiance at points (query.comp).
struct QueryPush {
    uvec2 queries;     // FieldQuery[count]
    uvec2 irradiance;  // vec3[count]
    uint count;
};

// Closest hits, occlusion and surfaces of given rays (trace_rays.comp, trace_occlusion.comp, surfaces.comp).
struct RaysPush {
    uvec2 rays;     // Ray[count]
    uvec2 hits;     // Hit[count]
    uvec2 results;  // occlusion: uint[count]; surfaces: GpuSurface[count]
    uint count;
    float spread;  // surfaces: cone angle of texture filtering, radians; 0: unfiltered
};

// probegi::Surface in a buffer, where GLSL has no bool.
struct GpuSurface {
    vec3 position;
    vec3 geometricNormal;
    vec3 shadingNormal;
    vec3 albedo;
    vec3 emission;
    float metallic;
    float roughness;
    int material;
    int side;  // kSideFront, kSideBack (of a double-sided material), kSideBackface
};
KERNEL_CONST int kSideFront = 0;
KERNEL_CONST int kSideBack = 1;
KERNEL_CONST int kSideBackface = 2;

// What the passes of PictureDesc::contact read and write, a value a pixel (picture_contact_*.comp).
struct ContactBlock {
    uvec2 found;           // ContactFound[pixel of the frame]
    uvec2 blurred;         // vec4[pixel of the frame]
    uvec2 kept;            // the same, with the history; without one the same buffer
    uvec2 past;            // ContactRecord[pixel of the picture] of the picture before; 0: none
    uvec2 records;         // the same of this picture
    PinholeCamera camera;  // of `past`
    float reach;           // metres
    int round;             // of the first plane's noise
    int rows;              // of the picture
    int limited;           // 1: contactShare() counts, since there is a field
};

// Samples of a frame of a picture, those of one pixel side by side (picture_*.comp).
struct PicturePush {
    uvec2 samples;   // ScreenSample[row][column][plane]
    uvec2 layers;    // vec3[layer][pixel of the frame]
    uvec2 lighting;  // LightingBlock
    PinholeCamera camera;
    int width;  // pixels
    int firstRow;
    int rows;  // of the frame
    int samplesPerAxis;
    int firstPlane;
    int planes;        // of the frame
    uint sampleCount;  // of the frame
    int flags;         // kPictureDiffuseOnly ...
    // ScreenSample[block], what glossy rays hit; GlossySample[block]; vec3[pixel], the light of the glossy lobes
    uvec2 glossy;
    uvec2 contact;  // ContactBlock
};
KERNEL_CONST int kPictureDiffuseOnly = 1;
KERNEL_CONST int kPictureGlossy = 2;        // passes of PictureDesc::glossy
KERNEL_CONST int kPictureSecondGlossy = 4;  // Glossy::field
KERNEL_CONST int kPictureContact = 8;       // passes of PictureDesc::contact

// Linear values to 8-bit sRGB (tone_map.comp).
struct ToneMapPush {
    uvec2 pixels;   // vec3[row][column]
    uvec2 display;  // uint[row][column], RGBA8, red in the lowest byte
    uint width;     // pixels
    uint height;
    float exposure;
    int filmic;
    int dither;
};

KERNELS_END

#ifdef __cplusplus
namespace probegi::kernels {
static_assert(offsetof(SceneConstants, tracer) == 140 && sizeof(SceneConstants) == 204 && sizeof(LightingBlock) == 40);
static_assert(sizeof(WeightsPush) == 60 && sizeof(SolidPush) == 16 && sizeof(BlendPush) == 116 &&
              sizeof(EnterPush) == 40 && sizeof(PlacementsPush) == 28 && sizeof(PlacesPush) == 96 &&
              sizeof(TracePush) == 76);
static_assert(sizeof(QueryPush) == 20 && sizeof(RaysPush) == 32 && sizeof(PicturePush) == 120 &&
              sizeof(ContactBlock) == 104);
static_assert(sizeof(TasksPush) == 24 && sizeof(FilterPush) == 88 && sizeof(EventPush) == 56 &&
              sizeof(EventRegion) == 32 && sizeof(GpuProbeStep) == 84);
static_assert(sizeof(ToneMapPush) == 36 && sizeof(GpuSurface) == 76);
}  // namespace probegi::kernels
#endif

#endif
