// The field in your own shaders: how much light arrives at a point that faces a normal (DDGI paper, section 2.2).
//
//     #define PROBEGI_SET 1        // descriptor set, and the first of four bindings in it, that were given to
//     #define PROBEGI_BINDING 0    // ProbeVolume::queryBindings() and writeQueryBindings()
//     #include "probegi/query.glsl"
//     ...
//     vec3 e = probegiIrradiance(position, normal, toViewer);  // W m^-2
//     color += albedo * e / 3.14159265;                        // what a Lambert surface reflects
//
// Needs GLSL 4.60 and GL_EXT_scalar_block_layout. All names begin with probegi, PROBEGI, or are those of the kernels
// below. With PROBEGI_COUNT_FALLBACKS defined, queries that no probe of their cage could answer are counted for
// Field::fallbackQueries(); the stage then needs atomics on storage buffers.
#ifndef PROBEGI_QUERY_GLSL
#define PROBEGI_QUERY_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "kernels/gpu_volume.h"
#include "kernels/irradiance_decoding.h"
#include "kernels/octahedral.h"
#include "kernels/probe_cage.h"
#include "kernels/probe_neighbours.h"

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

// For ray data of your own: how many probes there are, and where each stands. Its rays begin there.
int probegiProbeCount() {
    return probegiVolume.counts.x * probegiVolume.counts.y * probegiVolume.counts.z;
}
vec3 probegiProbePosition(int probe) {
    return probePlace(gpuProbeCell(probe, probegiVolume.counts), probegiVolume.origin, probegiVolume.spacing);
}

// What a probe stores towards a normal, encoded. `texel`: octTexelPosition of the normal.
vec3 probegiStored(ivec3 cell, vec2 texel) {
    const vec2 at = gpuAtlasCoordinates(cell, texel, probegiVolume.irradianceTexels, probegiVolume.irradianceTexelSize);
    return textureLod(probegiIrradianceAtlas, vec3(at, float(cell.z)), 0.0).rgb;
}

// Mean and mean square of distance, as fractions of the farthest, that a probe stores in a direction.
vec2 probegiMoments(ivec3 cell, vec3 direction) {
    const vec2 texel = octTexelPosition(octEncode(direction), probegiVolume.visibilityTexels);
    const vec2 at = gpuAtlasCoordinates(cell, texel, probegiVolume.visibilityTexels, probegiVolume.visibilityTexelSize);
    return textureLod(probegiVisibilityAtlas, vec3(at, float(cell.z)), 0.0).rg;
}

// Leak guard: how far a probe of the cage may be used. `fromProbe`: to the biased point, metres.
float probegiGuard(ivec3 cell, vec3 fromProbe) {
    if (probegiVolume.guard == kGuardNone) return 1.0;
    const vec2 moments = probegiMoments(cell, fromProbe);
    return chebyshevWeight(moments.x, moments.y, length(fromProbe) * probegiVolume.inverseMaxDistance);
}

// The same for the wider search.
float probegiNeighbourGuard(ivec3 cell, vec3 fromProbe) {
    if (probegiVolume.guard == kGuardNone) return 1.0;
    return neighbourVisibility(probegiMoments(cell, fromProbe),
                               (length(fromProbe) + kNoLength) * probegiVolume.inverseMaxDistance);
}

float probegiOutside(ivec3 cell) {
    return outsideWeight(probegiStates.backfaceShare[probeNumber(cell, probegiVolume.counts)]);
}

// E where the cage does not know; `local`: the point in the grid.
vec3 probegiNeighbours(vec3 position, vec3 normal, vec3 bias, vec3 local, vec2 texel) {
    const ivec3 lowest = searchLowest(local, probegiVolume.counts);
    const ivec3 highest = searchHighest(local, probegiVolume.counts);
    vec3 sum = vec3(0.0);
    float weightSum = 0.0;
    for (int z = lowest.z; z <= highest.z; ++z) {
        for (int y = lowest.y; y <= highest.y; ++y) {
            for (int x = lowest.x; x <= highest.x; ++x) {
                const ivec3 cell = ivec3(x, y, z);
                const float outside = probegiOutside(cell);
                if (outside <= 0.0) continue;
                const vec3 toProbe = probePlace(cell, probegiVolume.origin, probegiVolume.spacing) - position;
                const float visible = probegiNeighbourGuard(cell, bias - toProbe);
                const float weight = neighbourWeight(outside, toProbe, normal, visible, probegiVolume.minSpacing);
                const vec3 stored = probegiStored(cell, texel);
                sum += weight * kPi *
                       vec3(decodeIrradiance(stored.x), decodeIrradiance(stored.y), decodeIrradiance(stored.z));
                weightSum += weight;
            }
        }
    }
    return weightSum > 0.0 ? sum / weightSum : vec3(0.0);
}

// Irradiance E in W m^-2 at a point of a surface that faces `normal`, seen from the direction `toViewer` (both unit;
// use the normal where there is no viewer). Outside the volume its nearest cell answers.
vec3 probegiIrradiance(vec3 point, vec3 normal, vec3 toViewer) {
    const ivec3 counts = probegiVolume.counts;
    const vec3 position = clampToGrid(point, probegiVolume.origin, probegiVolume.spacing, counts);
    const vec3 bias = selfShadowBias(normal, toViewer, probegiVolume.minSpacing, probegiVolume.selfShadowBias);
    const vec3 local = gridCoordinates(position + kCageBias * bias, probegiVolume.origin, probegiVolume.inverseSpacing);
    const vec3 base = cageBase(local, counts);
    const vec3 alpha = cageAlpha(local, base);
    const vec2 texel = octTexelPosition(octEncode(normal), probegiVolume.irradianceTexels);
    vec3 sum = vec3(0.0);
    float weightSum = 0.0;
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        const ivec3 cell = ivec3(base) + corner;
        const vec3 toProbe = probePlace(cell, probegiVolume.origin, probegiVolume.spacing) - position;
        const float cosToProbe = cosineToProbe(dot(toProbe, normal), length(toProbe), probegiVolume.minSpacing);
        const float trilinear = trilinearFactor(float(corner.x), alpha.x) * trilinearFactor(float(corner.y), alpha.y) *
                                trilinearFactor(float(corner.z), alpha.z);
        const float weight = crushWeight(backfaceWeight(cosToProbe) * probegiGuard(cell, bias - toProbe)) * trilinear *
                             probegiOutside(cell);
        const vec3 stored = probegiStored(cell, texel);
        sum += weight * vec3(decodeToBlendSpace(stored.x), decodeToBlendSpace(stored.y), decodeToBlendSpace(stored.z));
        weightSum += weight;
    }
    if (weightSum >= kDoubtful) {
        const vec3 root = sum / weightSum;
        return root * root * kPi;
    }
#ifdef PROBEGI_COUNT_FALLBACKS
    atomicAdd(probegiStates.fallbacks, 1u);
#endif
    return completedByNeighbours(sum, weightSum, probegiNeighbours(position, normal, bias, local, texel));
}

#endif
