// The field in your own shaders: how much light arrives at a point that faces a normal (DDGI paper, section 2.2).
//
//     #define PROBEGI_SET 1        // descriptor set, and the first of four bindings in it, that were given to
//     #define PROBEGI_BINDING 0    // GpuField::queryBindings() and writeQueryBindings()
//     #include "probegi/query.glsl"
//     ...
//     vec3 e = probegiIrradiance(position, normal, toViewer);  // W m^-2; vec3(0): nobody looks
//     color += albedo * e / 3.14159265;                        // what a Lambert surface reflects
//
// Needs GLSL 4.60 and GL_EXT_scalar_block_layout. All names begin with probegi, PROBEGI, or are those of the kernels
// below. With PROBEGI_COUNT_FALLBACKS defined, queries that no probe of their cage could answer are counted for
// Field::fallbackQueries(); the stage then needs atomics on storage buffers.
#ifndef PROBEGI_QUERY_GLSL
#define PROBEGI_QUERY_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "kernels/abi/field_constants.h"
#include "kernels/probe/irradiance_decoding.h"
#include "kernels/probe/octahedral.h"
#include "kernels/volume/probe_cage.h"
#include "kernels/volume/volume_frame.h"
#include "kernels/lookup/probe_neighbours.h"
#include "kernels/lookup/surface_gradient.h"

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

layout(set = PROBEGI_SET, binding = PROBEGI_BINDING, scalar) uniform ProbegiConstants {
    FieldConstants probegiField;
};
#define probegiVolume probegiField.volumes[0]
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 1) uniform sampler2DArray probegiIrradianceAtlas;
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 2) uniform sampler2DArray probegiVisibilityAtlas;
layout(set = PROBEGI_SET, binding = PROBEGI_BINDING + 3, scalar) PROBEGI_STATES_ACCESS buffer ProbegiStates {
    uint fallbacks;
    float backfaceShare[];
}
probegiStates;

// For ray data of your own: how many probes there are, and where each stands. Its rays begin there.
int probegiProbeCount() {
    const Volume last = probegiField.volumes[probegiField.volumeCount - 1];
    return last.firstSlot + volumeProbes(last);
}
int probegiVolumeOf(int slot) {
    int volume = 0;
    while (volume + 1 < probegiField.volumeCount && slot >= probegiField.volumes[volume + 1].firstSlot) ++volume;
    return volume;
}
vec3 probegiProbePosition(int slot) {
    const Volume volume = probegiField.volumes[probegiVolumeOf(slot)];
    return probePosition(volume, probeCell(volume, slot));
}

// What a probe stores towards a normal, encoded. `texel`: octTexelPosition of the normal.
vec3 probegiStored(ivec3 cell, vec2 texel) {
    const ivec3 tile = poolTile(probegiField.tiles, probeSlot(probegiVolume, cell));
    const vec2 at = atlasCoordinates(tile, texel, probegiField.irradianceTexels, probegiField.irradianceTexelSize);
    return textureLod(probegiIrradianceAtlas, vec3(at, float(tile.z)), 0.0).rgb;
}

// Mean and mean square of distance, as fractions of the farthest, that a probe stores in a direction.
vec2 probegiMoments(int slot, vec3 direction) {
    const ivec3 tile = poolTile(probegiField.tiles, slot);
    const vec2 texel = octTexelPosition(octEncode(direction), probegiField.visibilityTexels);
    const vec2 at = atlasCoordinates(tile, texel, probegiField.visibilityTexels, probegiField.visibilityTexelSize);
    return textureLod(probegiVisibilityAtlas, vec3(at, float(tile.z)), 0.0).rg;
}

// Leak guard: how far a probe of the cage may be used. `fromProbe`: to the biased point, metres.
float probegiGuard(ivec3 cell, vec3 fromProbe) {
    if (probegiField.guard == kGuardNone) return 1.0;
    const vec2 moments = probegiMoments(probeSlot(probegiVolume, cell), fromProbe);
    return chebyshevWeight(moments.x, moments.y, length(fromProbe) * probegiVolume.inverseMaxDistance,
                           probegiField.rules);
}

// The same for the neighbours of a cage that does not know.
float probegiNeighbourGuard(ivec3 cell, vec3 fromProbe) {
    if (probegiField.guard == kGuardNone) return 1.0;
    return neighbourVisibility(probegiMoments(probeSlot(probegiVolume, cell), fromProbe),
                               (length(fromProbe) + kNoLength) * probegiVolume.inverseMaxDistance);
}

// How far a probe may be used at all.
float probegiOutside(ivec3 cell) {
    return outsideWeight(probegiStates.backfaceShare[probeSlot(probegiVolume, cell)], probegiField.rules);
}

// What a probe answers in the space in which probes are blended.
vec3 probegiRoot(ivec3 cell, vec2 texel) {
    const vec3 stored = probegiStored(cell, texel);
    return vec3(decodeToBlendSpace(stored.x), decodeToBlendSpace(stored.y), decodeToBlendSpace(stored.z));
}

// E where the cage does not know; `base`: its lowest probe.
vec3 probegiNeighbours(vec3 position, vec3 normal, vec3 bias, ivec3 base, vec2 texel) {
    vec3 sum = vec3(0.0);
    float weightSum = 0.0;
    for (int i = 0; i < kNeighbours; ++i) {
        const ivec3 cell = neighbourCell(base, i);
        if (!isInGrid(cell, probegiVolume.counts)) continue;
        const float outside = probegiOutside(cell);
        if (outside <= 0.0) continue;
        const vec3 toProbe = probePlace(cell, probegiVolume.origin, probegiVolume.spacing) - position;
        const float visible = probegiNeighbourGuard(cell, bias - toProbe);
        const float weight = neighbourWeight(outside, toProbe, normal, visible, probegiVolume.minSpacing);
        const vec3 stored = probegiStored(cell, texel);
        sum += weight * kPi * vec3(decodeIrradiance(stored.x), decodeIrradiance(stored.y), decodeIrradiance(stored.z));
        weightSum += weight;
    }
    return weightSum > 0.0 ? sum / weightSum : vec3(0.0);
}

// Which layer of probes tells how light changes along a normal (kernels/lookup/surface_gradient.h).
struct ProbegiFront {
    int axis;
    int side;     // 1 or 0: the cage's layer in front, along the axis
    ivec3 step;   // to the layer beyond
    float trust;  // 0 where that layer is not in the grid
};

ProbegiFront probegiFront(vec3 normal, ivec3 base) {
    ProbegiFront front;
    front.axis = dominantAxis(normal);
    front.side = normal[front.axis] > 0.0 ? 1 : 0;
    front.step = ivec3(0);
    front.step[front.axis] = 2 * front.side - 1;
    const int beyond = base[front.axis] + (front.side == 1 ? 2 : -1);
    const bool known =
        probegiField.rules == kRulesMeasured && beyond >= 0 && beyond < probegiVolume.counts[front.axis];
    front.trust = known ? axisTrust(normal) : 0.0;
    return front;
}

// How far a probe in front and the one beyond may tell.
float probegiPair(ivec3 cell, ProbegiFront front) {
    const float outside = probegiOutside(cell + front.step);
    if (probegiField.guard == kGuardNone) return outside;
    const vec2 moments = probegiMoments(probeSlot(probegiVolume, cell), vec3(front.step));
    return outside * chebyshevWeight(moments.x, moments.y,
                                     probegiVolume.spacing[front.axis] * probegiVolume.inverseMaxDistance,
                                     probegiField.rules);
}

// Irradiance E in W m^-2 at a point of a surface that faces `normal`, seen from the direction `viewer` (both unit; zero
// stands for the normal, where nobody looks). Outside the volume its nearest cell answers.
vec3 probegiIrradiance(vec3 point, vec3 normal, vec3 viewer) {
    const vec3 toViewer = viewerOf(viewer, normal);
    const ivec3 counts = probegiVolume.counts;
    const int rules = probegiField.rules;
    const float minSpacing = probegiVolume.minSpacing;
    const vec3 position = clampToGrid(point, probegiVolume.origin, probegiVolume.spacing, counts);
    const vec3 bias = visibilityBias(normal, toViewer, minSpacing, probegiField.selfShadowBias, rules);
    const vec3 moved = position + cageBias(normal, toViewer, minSpacing, probegiField.selfShadowBias, rules);
    const vec3 local = gridCoordinates(moved, probegiVolume.origin, probegiVolume.inverseSpacing);
    const vec3 base = cageBase(local, counts);
    const vec3 alpha = cageAlpha(local, base);
    const vec2 texel = octTexelPosition(octEncode(normal), probegiField.irradianceTexels);
    const ProbegiFront front = probegiFront(normal, ivec3(base));
    // The pair's weight is that of the probe in front, without the share that the point's depth gives to its layer.
    const float alongAxis = trilinearFactor(float(front.side), alpha[front.axis]);
    vec3 sum = vec3(0.0);
    vec3 rise = vec3(0.0);
    float weightSum = 0.0;
    float ahead = 0.0;
    float pairWeight = 0.0;
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        const ivec3 cell = ivec3(base) + corner;
        const vec3 toProbe = probePlace(cell, probegiVolume.origin, probegiVolume.spacing) - position;
        const float cosToProbe = cosineToProbe(dot(toProbe, normal), length(toProbe), minSpacing);
        const float trilinear = trilinearFactor(float(corner.x), alpha.x) * trilinearFactor(float(corner.y), alpha.y) *
                                trilinearFactor(float(corner.z), alpha.z);
        const float weight = crushWeight(backfaceWeight(cosToProbe, rules) * probegiGuard(cell, bias - toProbe)) *
                             trilinear * probegiOutside(cell);
        const vec3 root = probegiRoot(cell, texel);
        sum += weight * root;
        weightSum += weight;
        ahead += weight * dot(toProbe, normal);
        if (front.trust > 0.0 && corner[front.axis] == front.side) {
            const float pair = weight / alongAxis * probegiPair(cell, front);
            rise += pair * (probegiRoot(cell + front.step, texel) - root);
            pairWeight += pair;
        }
    }
    if (rules == kRulesPaper || weightSum >= kDoubtful) {
        const vec3 root = sum / weightSum;
        if (front.trust <= 0.0) return root * root * kPi;
        const float cells = cellsAhead(ahead / weightSum, probegiVolume.spacing[front.axis], normal[front.axis]);
        const vec3 there = vec3(rootAtSurface(root.x, rise.x, pairWeight, cells, front.trust),
                                rootAtSurface(root.y, rise.y, pairWeight, cells, front.trust),
                                rootAtSurface(root.z, rise.z, pairWeight, cells, front.trust));
        return there * there * kPi;
    }
#ifdef PROBEGI_COUNT_FALLBACKS
    atomicAdd(probegiStates.fallbacks, 1u);
#endif
    return completedByNeighbours(sum, weightSum, probegiNeighbours(position, normal, bias, ivec3(base), texel));
}

#endif
