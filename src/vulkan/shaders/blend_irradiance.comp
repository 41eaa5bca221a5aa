// New irradiance of all probes = weights x ray data, one matrix product for the frame since all probes share the rays'
// directions; then encoding, hysteresis, dithered storage and the border, fused (DDGI paper, section 2.3, eq. 1,
// Listings 1 and 3). A work group makes kTexels texels of kProbes probes, in steps of kRays rays through shared memory;
// a thread holds a block of 4 texels x 4 probes in registers, so that eight loads feed 48 multiply-adds.
#include "ray_data.glsl"
#include "volume.glsl"

#include "kernels/gpu_passes.h"
#include "kernels/octahedral_texel.h"
#include "kernels/probe_texel.h"

layout(constant_id = 0) const uint kExcludeBackfaces = 0;  // BackfaceRule::excluded
layout(push_constant, scalar) uniform Push {
    BlendPush push;
};

const int kTexels = 64;
const int kProbes = 16;
const int kRays = 16;
const int kBlock = 4;  // texels, and probes, of a thread
const int kTexelThreads = kTexels / kBlock;

shared vec4 radiance[kRays][kProbes];  // w: 1 where the ray counts
shared float weights[kRays][kTexels];
shared uint hits[kProbes];
shared uint backfaces[kProbes];

// The group's rays from `first` on. What is beyond the last ray or probe counts as nothing.
void loadRays(int firstProbe, int firstRay) {
    for (int i = int(gl_LocalInvocationID.x); i < kRays * kProbes; i += int(gl_WorkGroupSize.x)) {
        const int ray = firstRay + i % kRays;
        const int probe = firstProbe + i / kRays;
        vec4 value = vec4(0.0);
        if (ray < push.rays && probe < push.probes) {
            const RayDatum d = RayData(push.rayData).at[probe * push.rays + ray];
            const float distance = safeDistance(d.distance);
            const bool backface = hitBackface(distance);
            if (!backface)
                value = vec4(safeRadiance(d.radiance.x), safeRadiance(d.radiance.y), safeRadiance(d.radiance.z), 1.0);
            if (distance < kMissDistance) atomicAdd(hits[i / kRays], 1);
            if (backface) atomicAdd(backfaces[i / kRays], 1);
        }
        radiance[i % kRays][i / kRays] = value;
    }
}

void loadWeights(int firstTexel, int texels, int firstRay) {
    for (int i = int(gl_LocalInvocationID.x); i < kRays * kTexels; i += int(gl_WorkGroupSize.x)) {
        const int ray = firstRay + i / kTexels;
        const int texel = firstTexel + i % kTexels;
        const bool inside = ray < push.rays && texel < texels;
        weights[i / kTexels][i % kTexels] =
            inside ? Floats(push.irradianceWeights).at[ray * texels + texel] : 0.0;
    }
}

void store(int probe, int texel, vec3 newMean) {
    const int size = probegiVolume.irradianceTexels;
    const ivec3 cell = gpuProbeCell(probe, probegiVolume.counts);
    const ivec2 tile = gpuTileOrigin(cell, size);
    const ivec2 at = ivec2(texel % size, texel / size);
    const vec3 old = imageLoad(irradianceImage, ivec3(tile + at, cell.z)).rgb;
    const BlendRule rule = BlendRule(push.irradianceHysteresis, push.significantChange, push.newDistribution);
    const uvec3 bits = blendIrradianceTexel(old, newMean, rule, push.linear != 0, push.ditherSeed,
                                            uint(probe * size * size + texel));
    // Exact in the image's halves: they were rounded already, with the dither.
    const vec4 stored = vec4(unpackHalf(bits.x), unpackHalf(bits.y), unpackHalf(bits.z), 0.0);
    imageStore(irradianceImage, ivec3(tile + at, cell.z), stored);
    for (int copy = 0; copy < 3; ++copy) {
        const ivec2 border = octBorderTexel(at.x, at.y, size, copy);
        if (border != at) imageStore(irradianceImage, ivec3(tile + border, cell.z), stored);
    }
}

void main() {
    const int texels = probegiVolume.irradianceTexels * probegiVolume.irradianceTexels;
    const int firstProbe = int(blockIndex()) * kProbes;
    const int firstTexel = int(gl_WorkGroupID.y) * kTexels;
    const int thread = int(gl_LocalInvocationID.x);
    const int myTexel = thread % kTexelThreads;
    const int myProbe = thread / kTexelThreads * kBlock;
    if (thread < kProbes) {
        hits[thread] = 0;
        backfaces[thread] = 0;
    }
    vec4 sum[kBlock][kBlock];
    for (int t = 0; t < kBlock; ++t)
        for (int p = 0; p < kBlock; ++p) sum[t][p] = vec4(0.0);

    for (int ray = 0; ray < push.rays; ray += kRays) {
        barrier();
        loadRays(firstProbe, ray);
        loadWeights(firstTexel, texels, ray);
        barrier();
        for (int k = 0; k < kRays; ++k) {
            vec4 l[kBlock];
            float w[kBlock];
            for (int i = 0; i < kBlock; ++i) {
                l[i] = radiance[k][myProbe + i];
                w[i] = weights[k][myTexel + kTexelThreads * i];
            }
            for (int t = 0; t < kBlock; ++t) {
                for (int p = 0; p < kBlock; ++p) {
                    sum[t][p].xyz += w[t] * l[p].xyz;
                    if (kExcludeBackfaces != 0) sum[t][p].w += w[t] * l[p].w;
                }
            }
        }
    }
    for (int t = 0; t < kBlock; ++t) {
        for (int p = 0; p < kBlock; ++p) {
            const int texel = firstTexel + myTexel + kTexelThreads * t;
            const int probe = firstProbe + myProbe + p;
            if (texel >= texels || probe >= push.probes) continue;
            const vec4 mean = sum[t][p];
            store(probe, texel, kExcludeBackfaces == 0 ? mean.xyz
                                                       : vec3(withoutBackfaces(mean.x, mean.w),
                                                              withoutBackfaces(mean.y, mean.w),
                                                              withoutBackfaces(mean.z, mean.w)));
        }
    }
    barrier();
    const int probe = firstProbe + thread;
    if (gl_WorkGroupID.y == 0 && thread < kProbes && probe < push.probes) {
        const float share = backfaceShareOf(int(backfaces[thread]), int(hits[thread]));
        probegiStates.backfaceShare[probe] = mix(share, probegiStates.backfaceShare[probe], push.visibilityHysteresis);
    }
}
