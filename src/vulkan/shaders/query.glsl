// The field in your own shaders: how much light arrives at a point that faces a normal (DDGI paper, section 2.2).
//
//     #define PROBEGI_SET 1        // descriptor set, and the first of four bindings in it, that were given to
//     #define PROBEGI_BINDING 0    // ProbeVolume::queryBindings() and writeQueryBindings()
//     #include "probegi/query.glsl"
//     ...
//     vec3 e = probegiIrradiance(position, normal, toViewer);  // W m^-2; vec3(0): nobody looks
//     color += albedo * e / 3.14159265;                        // what a Lambert surface reflects
//
// Needs GLSL 4.60 and GL_EXT_scalar_block_layout. All names begin with probegi, PROBEGI, or are those of the kernels
// below. With PROBEGI_COUNT_FALLBACKS defined, queries whose cage had too little weight are counted for
// Field::fallbackQueries(); the stage then needs atomics on storage buffers.
#ifndef PROBEGI_QUERY_GLSL
#define PROBEGI_QUERY_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "kernels/lookup/access.h"
#include "kernels/probe/octahedral.h"
#include "kernels/volume/gpu_volume.h"
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

layout(set = PROBEGI_SET, binding = PROBEGI_BINDING, scalar) uniform ProbegiVolume {
    GpuVolume probegiVolume;
};
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 1) uniform sampler2DArray probegiIrradianceAtlas;
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 2) uniform sampler2DArray probegiVisibilityAtlas;
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 3, scalar) PROBEGI_STATES_ACCESS buffer ProbegiStates {
    uint fallbacks;
    float backfaceShare[];
}
probegiStates;

// The field's volumes.
int probegiVolumeCount() {
    return 1;
}
Volume probegiVolumeAt(int i) {
    Volume v;
    v.origin = probegiVolume.origin;
    v.minSpacing = probegiVolume.minSpacing;
    v.spacing = probegiVolume.spacing;
    v.firstSlot = 0;
    v.inverseSpacing = probegiVolume.inverseSpacing;
    v.inverseMaxDistance = probegiVolume.inverseMaxDistance;
    v.counts = probegiVolume.counts;
    v.turned = 0;
    v.orientation = vec4(0.0, 0.0, 0.0, 1.0);
    v.phase = ivec3(0);
    return v;
}

// For ray data of your own: how many probes there are, and where each stands. Its rays begin there.
int probegiProbeCount() {
    return volumeProbes(probegiVolumeAt(0));
}
vec3 probegiProbePosition(int probe) {
    const Volume v = probegiVolumeAt(0);
    return probePosition(v, probeCell(v, probe));
}

// Texture coordinates of a point of a slot's map, `texel`: octTexelPosition().
vec3 probegiIrradianceAt(int slot, vec2 texel) {
    const ivec3 tile = gpuProbeCell(slot, probegiVolume.counts);
    return vec3(gpuAtlasCoordinates(tile, texel, probegiVolume.irradianceTexels, probegiVolume.irradianceTexelSize),
                float(tile.z));
}
vec3 probegiVisibilityAt(int slot, vec2 texel) {
    const ivec3 tile = gpuProbeCell(slot, probegiVolume.counts);
    return vec3(gpuAtlasCoordinates(tile, texel, probegiVolume.visibilityTexels, probegiVolume.visibilityTexelSize),
                float(tile.z));
}

// How the look-up reads the field: what kernels/lookup/access.h asks for.
struct Access {
    int rules;
    int guard;
    float selfShadowBias;
};
#define MapPoint vec2

Access probegiAccess() {
    Access access;
    access.rules = probegiVolume.rules;
    access.guard = probegiVolume.guard;
    access.selfShadowBias = probegiVolume.selfShadowBias;
    return access;
}
vec2 visibilityPoint(Access access, vec3 direction) {
    return octTexelPosition(octEncode(direction), probegiVolume.visibilityTexels);
}
vec2 irradiancePoint(Access access, vec3 normal) {
    return octTexelPosition(octEncode(normal), probegiVolume.irradianceTexels);
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
    return probegiStates.backfaceShare[slot];
}
vec3 storedIrradiance(Access access, int slot, vec2 at) {
    return textureLod(probegiIrradianceAtlas, probegiIrradianceAt(slot, at), 0.0).rgb;
}
float givenVisibility(Access access, int corner) {
    return 1.0;
}
void countFallback(Access access) {
#ifdef PROBEGI_COUNT_FALLBACKS
    atomicAdd(probegiStates.fallbacks, 1u);
#endif
}

#include "kernels/lookup/irradiance.h"

// Mean and mean square of distance, as fractions of the farthest, that a probe stores in a direction.
vec2 probegiMoments(int slot, vec3 direction) {
    const Access access = probegiAccess();
    vec2 moments;
    storedMoments(access, slot, visibilityPoint(access, direction), moments.x, moments.y);
    return moments;
}

// The volume that answers at a point: the first that holds it, else the nearest.
int probegiVolumeOf(vec3 point) {
    if (probegiVolumeCount() == 1) return 0;
    VolumeChoice choice = noVolume();
    for (int i = 0; i < probegiVolumeCount(); ++i) choice = chooseVolume(choice, probegiVolumeAt(i), i, point);
    return choice.volume;
}

// Irradiance E in W m^-2 at a point of a surface that faces `normal`, seen from the direction `viewer` (both unit; zero
// stands for the normal, where nobody looks). Outside all volumes the nearest cell answers.
vec3 probegiIrradiance(vec3 point, vec3 normal, vec3 viewer) {
    return irradianceIn(probegiAccess(), probegiVolumeAt(probegiVolumeOf(point)), point, normal, viewer);
}

#endif
