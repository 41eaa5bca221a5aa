// Irradiance of all probes = weights x ray data: one matrix product for the frame, since all probes share the rays'
// directions. Encoding, hysteresis, dithered storage and the border are fused into the same pass (DDGI paper, section
// 2.3, eq. 1, Listings 1 and 3). A work group computes kTexels texels of kProbes probes, staging kRays rays at a time
// in shared memory. Each thread holds a block of 4 texels x 4 probes in registers, so that seven loads of 16 floats
// feed 48 multiply-adds. (Shared memory delivers one register per clock, whether or not all threads read the same one:
// a thread for one texel of eight probes would read 25 floats for 24 multiply-adds.)
#include "emitter_lights.glsl"
#include "filter.glsl"
#include "ray_data.glsl"
#include "sides.glsl"
#include "tasks.glsl"
#include "volume.glsl"

#include "kernels/abi/gpu_passes.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/probe_texel.h"

layout(constant_id = 0) const uint kExcludeBackfaces = 0;  // BackfaceRule::excluded
layout(push_constant, scalar) uniform Push {
    BlendPush push;
};

const int kTexels = kIrradianceGroupTexels;
const int kProbes = kIrradianceGroupProbes;
const int kRays = 16;
const int kBlock = 4;  // texels, and probes, per thread; a thread also loads a ray for as many probes
const int kTexelThreads = kTexels / kBlock;

const int kFours = kProbes / 4;

// Per group of four probes: red, green, blue, and 1 if the ray counts.
shared vec4 radiance[kFours][4][kRays];
shared float weights[kRays][kTexels];
shared TexelChange changes[kProbes][kTexelThreads];  // of a probe's texels, by thread
shared uvec4 counts[kFours][kRays];                  // packSides() of the rays that each thread loaded

// Loads the group's rays from `firstRay` on, each thread one ray for four probes. Entries beyond the last ray or probe
// are zero. Each thread stores whole vectors, so that no two write to the same one.
void loadRays(int tasks, int firstTask, int firstRay, inout uvec4 seen) {
    const int four = int(gl_LocalInvocationID.x) / kRays;
    const int i = int(gl_LocalInvocationID.x) % kRays;
    const int ray = firstRay + i;
    vec4 value[4] = vec4[](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    for (int p = 0; p < 4; ++p) {
        const int task = firstTask + 4 * four + p;
        if (ray >= push.rays || task >= tasks) continue;
        const RayDatum d = rayDatumAt(push.rayData, push.packedRays != 0, uint(task * push.rays + ray));
        const float distance = safeDistance(d.distance);
        const vec3 light = arrivingRadiance(distance, d.radiance);
        const bool backface = hitBackface(distance, d.radiance.x);
        for (int c = 0; c < 3; ++c) value[c][p] = light[c];
        value[3][p] = backface ? 0.0 : 1.0;
        seen[p] += packSides(distance < kMissDistance, hitBack(distance), backface);
    }
    for (int c = 0; c < 4; ++c) radiance[four][c][i] = value[c];
}

void loadWeights(int firstTexel, int texels, int firstRay) {
    for (int i = int(gl_LocalInvocationID.x); i < kRays * kTexels; i += int(gl_WorkGroupSize.x)) {
        const int ray = firstRay + i / kTexels;
        const int texel = firstTexel + i % kTexels;
        const bool inside = ray < push.rays && texel < texels;
        weights[i / kTexels][i % kTexels] = inside ? Floats(push.irradianceWeights).at[ray * texels + texel] : 0.0;
    }
}

// The dither is seeded by the probe's number in its volume, so that it does not depend on other volumes.
void store(ProbeTask task, int texel, vec3 newMean, inout TexelChange change) {
    const int size = probegiField.irradianceTexels;
    const ivec3 place = poolTile(probegiField.tiles, int(task.slot));
    const ivec2 tile = tileOrigin(place, size);
    const uint number = uint(probeNumber(probegiField.volumes[task.volume], int(task.slot)));
    const ivec2 at = ivec2(texel % size, texel / size);
    const vec3 old = imageLoad(irradianceImage, ivec3(tile + at, place.z)).rgb;
    float kept = isNew(ProbeFilters(push.filters).at[task.slot]) ? 0.0 : push.irradianceHysteresis;
    if (push.steps != uvec2(0u)) {
        kept = ProbeSteps(push.steps).at[task.slot].irradianceKept;
        addTexelChange(change, old, newMean);
    }
    const BlendRule rule = BlendRule(kept, push.significantChange, push.newDistribution);
    const uvec3 bits = blendIrradianceTexel(old, newMean, rule, push.linear != 0, push.ditherSeed,
                                            number * uint(size * size) + uint(texel));
    // The image's halves hold these exactly: the dither has already rounded them.
    const vec4 stored = vec4(unpackHalf(bits.x), unpackHalf(bits.y), unpackHalf(bits.z), 0.0);
    imageStore(irradianceImage, ivec3(tile + at, place.z), stored);
    for (int copy = 0; copy < 3; ++copy) {
        const ivec2 border = octBorderTexel(at.x, at.y, size, copy);
        if (border != at) imageStore(irradianceImage, ivec3(tile + border, place.z), stored);
    }
}

// Mean radiance that the emitter samples add to a texel.
vec3 fromEmitters(int task, int texel) {
    const int size = probegiField.irradianceTexels;
    const vec3 n = octTexelDirection(texel % size, texel / size, size);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < push.looks; ++i) {
        const EmitterLight l = EmitterLights(push.emitterLights).at[task * push.looks + i];
        sum += irradianceWeight(n, l.direction) * l.light;
    }
    return sum;
}

void storeSides(int local, uint slot) {
    SidesSeen seen = SidesSeen(0, 0, 0);
    for (int i = 0; i < kRays; ++i) seen = addSides(seen, counts[local / 4][i][local % 4]);
    float kept = isNew(ProbeFilters(push.filters).at[slot]) ? 0.0 : push.visibilityHysteresis;
    if (push.steps != uvec2(0u)) kept = ProbeSteps(push.steps).at[slot].visibilityKept;
    const ProbeSides sides = rememberSides(Sides(push.sides).at[slot], seen, push.rays, kept);
    Sides(push.sides).at[slot] = sides;
    probegiStates.at[slot].backfaceShare =
        mix(solidShare(sides, seen, push.rays), probegiStates.at[slot].backfaceShare, kept);
}

void storeChange(int local, int task, int tasks) {
    TexelChange sum = noChange();
    for (int i = 0; i < kTexelThreads; ++i) joinChanges(sum, changes[local][i]);
    TexelChanges(push.changes).at[int(gl_WorkGroupID.y) * tasks + task] = sum;
}

void main() {
    const int texels = probegiField.irradianceTexels * probegiField.irradianceTexels;
    Tasks list = Tasks(push.tasks);
    const int tasks = int(list.counts.tasks);
    const int firstTask = int(blockIndex()) * kProbes;
    const int firstTexel = int(gl_WorkGroupID.y) * kTexels;
    const int thread = int(gl_LocalInvocationID.x);
    const int myTexel = thread % kTexelThreads;
    const int myFour = thread / kTexelThreads;
    uvec4 seen = uvec4(0u);
    vec4 sum[kBlock][4];  // [texel][channel], one component per probe
    for (int t = 0; t < kBlock; ++t)
        for (int c = 0; c < 4; ++c) sum[t][c] = vec4(0.0);

    for (int ray = 0; ray < push.rays; ray += kRays) {
        barrier();
        loadRays(tasks, firstTask, ray, seen);
        loadWeights(firstTexel, texels, ray);
        barrier();
        for (int k = 0; k < kRays; ++k) {
            float w[kBlock];
            for (int t = 0; t < kBlock; ++t) w[t] = weights[k][myTexel + kTexelThreads * t];
            for (int c = 0; c < 3; ++c) {
                const vec4 l = radiance[myFour][c][k];
                for (int t = 0; t < kBlock; ++t) sum[t][c] += w[t] * l;
            }
            if (kExcludeBackfaces != 0)
                for (int t = 0; t < kBlock; ++t) sum[t][3] += w[t] * radiance[myFour][3][k];
        }
    }
    for (int p = 0; p < 4; ++p) {
        TexelChange change = noChange();
        for (int t = 0; t < kBlock; ++t) {
            const int texel = firstTexel + myTexel + kTexelThreads * t;
            const int task = firstTask + 4 * myFour + p;
            if (texel >= texels || task >= tasks) continue;
            vec4 mean = vec4(sum[t][0][p], sum[t][1][p], sum[t][2][p], sum[t][3][p]);
            mean.xyz += fromEmitters(task, texel);
            store(list.at[task], texel,
                  kExcludeBackfaces == 0 ? mean.xyz
                                         : vec3(withoutBackfaces(mean.x, mean.w), withoutBackfaces(mean.y, mean.w),
                                                withoutBackfaces(mean.z, mean.w)),
                  change);
        }
        changes[4 * myFour + p][myTexel] = change;
    }
    counts[thread / kRays][thread % kRays] = seen;
    barrier();
    if (thread >= kProbes || firstTask + thread >= tasks) return;
    if (gl_WorkGroupID.y == 0) storeSides(thread, list.at[firstTask + thread].slot);
    if (push.steps != uvec2(0u)) storeChange(thread, firstTask + thread, tasks);
}
