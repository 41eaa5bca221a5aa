// The field in your own shaders: irradiance at a point for a surface normal (DDGI paper, section 2.2).
//
//     #define PROBEGI_SET 1        // the descriptor set, and the first of the four bindings in it, that you passed to
//     #define PROBEGI_BINDING 0    // GpuField::queryBindings() and writeQueryBindings()
//     #include "probegi/query.glsl"
//     ...
//     vec3 e = probegiIrradiance(position, normal, toViewer);  // W m^-2; toViewer may be vec3(0): no viewer
//     color += albedo * e / 3.14159265;                        // what a Lambert surface reflects
//
// Needs GLSL 4.60 and GL_EXT_scalar_block_layout. All names begin with probegi or PROBEGI, or are those of the kernels
// included below. If PROBEGI_COUNT_FALLBACKS is defined, queries whose cage had too little weight are counted for
// Field::fallbackQueries(); the shader stage then needs atomics on storage buffers. If PROBEGI_CONSTANTS_IN_BUFFER is
// defined, the first binding is a storage buffer: QueryConstants::storageBuffer. If PROBEGI_MASKS is defined, look-ups
// with LeakGuard::masks and sdfShadow read the field's masks and primitives, by their address
// (GL_EXT_buffer_reference); without it they go by the distance moments instead.
#ifndef PROBEGI_QUERY_GLSL
#define PROBEGI_QUERY_GLSL

#extension GL_EXT_scalar_block_layout : require
#ifdef PROBEGI_MASKS
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#endif

#include "kernels/abi/field_constants.h"
#include "kernels/lookup/access.h"
#include "kernels/probe/octahedral.h"
#include "kernels/probe/packed_ray.h"
#include "kernels/volume/placed_probe.h"
#include "kernels/volume/volume_choice.h"

#ifndef PROBEGI_SET
#define PROBEGI_SET 0
#endif
#ifndef PROBEGI_BINDING
#define PROBEGI_BINDING 0
#endif
#ifdef PROBEGI_COUNT_FALLBACKS
#define PROBEGI_STATES_ACCESS
#else
#define PROBEGI_STATES_ACCESS readonly
#endif
#ifdef PROBEGI_CONSTANTS_IN_BUFFER
#define PROBEGI_CONSTANTS_ACCESS readonly buffer
#else
#define PROBEGI_CONSTANTS_ACCESS uniform
#endif

layout(set = PROBEGI_SET, binding = PROBEGI_BINDING, scalar) PROBEGI_CONSTANTS_ACCESS ProbegiConstants {
    FieldConstants field;
}
probegiConstants;
#define probegiField probegiConstants.field
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 1) uniform sampler2DArray probegiIrradianceAtlas;
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 2) uniform sampler2DArray probegiVisibilityAtlas;
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 3, scalar) PROBEGI_STATES_ACCESS buffer ProbegiStates {
    uint fallbacks;
    ProbeStatus at[];
}
probegiStates;

#ifdef PROBEGI_MASKS
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer ProbegiMaskWords {
    int at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer ProbegiBlockers {
    SdfBlocker at[];
};
#endif

// The volume that owns a slot.
int probegiVolumeOf(int slot) {
    int volume = 0;
    while (volume + 1 < probegiField.volumeCount && slot >= probegiField.volumes[volume + 1].firstSlot) ++volume;
    return volume;
}

// For ray data of your own: the number of probes, and the position of each, where its rays begin.
int probegiProbeCount() {
    const Volume last = probegiField.volumes[probegiField.volumeCount - 1];
    return last.firstSlot + volumeProbes(last);
}
vec3 probegiProbePosition(int slot) {
    const Volume v = probegiField.volumes[probegiVolumeOf(slot)];
    return placedPosition(v, probeCell(v, slot), probegiStates.at[slot].placement);
}

// The directions of the coming update's rays, the same for all probes: those of FieldControl::rayDirections() and
// fixedRayDirections(), but for rounding. 0 <= ray < the number of them.
int probegiRayCount() {
    return probegiField.rays.count;
}
vec3 probegiRayDirection(int ray) {
    return rayOfSet(probegiField.rays, ray);
}
int probegiFixedRayCount() {
    return probegiField.rays.fixedCount;
}
vec3 probegiFixedRayDirection(int ray) {
    return fixedRayOfSet(probegiField.rays, ray);
}

// A ray's datum in 8 bytes, for RayFormat::packed; radiance and distance as in RayDatum.
uvec2 probegiPackRay(vec3 radiance, float distance) {
    return uvec2(packRadiance(unsignedRadiance(distance, radiance)),
                 floatBitsToUint(packRayDistance(distance, radiance.x)));
}

// Atlas coordinates of a point of a slot's map; `texel` is the point's octTexelPosition().
vec3 probegiIrradianceAt(int slot, vec2 texel) {
    const ivec3 tile = poolTile(probegiField.tiles, slot);
    return vec3(atlasCoordinates(tile, texel, probegiField.irradianceTexels, probegiField.irradianceTexelSize),
                float(tile.z));
}
vec3 probegiVisibilityAt(int slot, vec2 texel) {
    const ivec3 tile = poolTile(probegiField.tiles, slot);
    return vec3(atlasCoordinates(tile, texel, probegiField.visibilityTexels, probegiField.visibilityTexelSize),
                float(tile.z));
}

// How the look-up reads the field: the functions that kernels/lookup/access.h requires.
struct Access {
    int rules;
    int guard;
    float selfShadowBias;
    int maskTexels;
    int maskPacked;
    int blockers;
};
#define MapPoint vec2

Access probegiAccess() {
    Access access;
    access.rules = probegiField.rules;
    access.guard = probegiField.guard;
    access.selfShadowBias = probegiField.selfShadowBias;
    access.maskTexels = probegiField.maskTexels;
    access.maskPacked = probegiField.maskPacked;
    access.blockers = probegiField.blockerCount;
#ifndef PROBEGI_MASKS
    // Rows of kernels/guards/list.h: moments in place of masks and sdfShadow.
    if (access.guard == 2 || access.guard == 3) access.guard = 1;
#endif
    return access;
}
vec2 visibilityPoint(Access access, vec3 direction) {
    return octTexelPosition(octEncode(direction), probegiField.visibilityTexels);
}
vec2 irradiancePoint(Access access, vec3 normal) {
    return octTexelPosition(octEncode(normal), probegiField.irradianceTexels);
}
vec2 axisPoint(Access access, Volume v, int axis, bool up) {
    return visibilityPoint(access, axisDirection(v, axis, up));
}
void storedMoments(Access access, int slot, vec2 at, out float mean, out float meanSquare) {
    const vec2 moments = textureLod(probegiVisibilityAtlas, probegiVisibilityAt(slot, at), 0.0).rg;
    mean = moments.x;
    meanSquare = moments.y;
}
void momentsOnAxis(Access access, Volume v, int slot, vec2 at, out float mean, out float meanSquare) {
    storedMoments(access, slot, at, mean, meanSquare);
}
float storedBackfaceShare(Access access, int slot) {
    return probegiStates.at[slot].backfaceShare;
}
int storedPlacement(Access access, int slot) {
    return int(probegiStates.at[slot].placement);
}
vec3 storedIrradiance(Access access, int slot, vec2 at) {
    return textureLod(probegiIrradianceAtlas, probegiIrradianceAt(slot, at), 0.0).rgb;
}
int maskWord(Access access, int number) {
#ifdef PROBEGI_MASKS
    return ProbegiMaskWords(probegiField.masks).at[number];
#else
    return 0;  // not asked
#endif
}
SdfBlocker blockerAt(Access access, int number) {
#ifdef PROBEGI_MASKS
    return ProbegiBlockers(probegiField.blockers).at[number];
#else
    SdfBlocker none;
    return none;
#endif
}
float givenVisibility(Access access, int corner) {
    return 1.0;
}
void countFallback(Access access) {
#ifdef PROBEGI_COUNT_FALLBACKS
    atomicAdd(probegiStates.fallbacks, 1u);
#endif
}

int volumeCount(Access access) {
    return probegiField.volumeCount;
}
Volume volumeOfRank(Access access, int rank) {
    return probegiField.volumes[probegiField.blending.order[rank]];
}
bool rankTracksCamera(Access access, int rank) {
    return (probegiField.blending.tracking >> uint(probegiField.blending.order[rank]) & 1u) != 0u;
}
vec3 cameraPosition(Access access) {
    return probegiField.blending.camera;
}
bool outsideFades(Access access) {
    return probegiField.blending.outsideFades != 0;
}
vec3 outsideRadiance(Access access) {
    return probegiField.blending.outsideRadiance;
}

#include "kernels/lookup/volume_blend.h"

// Mean and mean square of the distance that a probe stores for a direction, as fractions of the farthest.
vec2 probegiMoments(int slot, vec3 direction) {
    const Access access = probegiAccess();
    vec2 moments;
    storedMoments(access, slot, visibilityPoint(access, direction), moments.x, moments.y);
    return moments;
}

// The densest of the volumes that contain a point, otherwise the nearest.
int probegiVolumeAt(vec3 point) {
    const Access access = probegiAccess();
    VolumeChoice choice = noVolume();
    for (int i = 0; i < probegiField.volumeCount; ++i)
        choice = chooseVolume(choice, volumeOfRank(access, i), probegiField.blending.order[i], point);
    return choice.volume;
}

// How far the volumes cover a point, 0..1: FieldControl::coverage().
float probegiCoverage(vec3 point) {
    return coverageAt(probegiAccess(), point);
}

// Irradiance E in W m^-2 at a point of a surface with this normal, seen from the direction `viewer` (both unit vectors;
// without a viewer pass zero, which stands for the normal). Volumes blend where they overlap; outside of all of them
// the nearest cell is used, or what FieldSettings::outside says.
vec3 probegiIrradiance(vec3 point, vec3 normal, vec3 viewer) {
    return blendedIrradiance(probegiAccess(), point, normal, viewer);
}

#endif
