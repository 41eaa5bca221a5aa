// New distance moments of all probes from the frame's sparse weights, then hysteresis, dithered storage and the border
// (DDGI paper, section 2.3). A thread makes one texel of kProbes probes; the lists of neighbouring texels lie side by
// side, and a probe's distances stay in the first-level cache.
#include "ray_data.glsl"
#include "volume.glsl"

#include "kernels/gpu_passes.h"
#include "kernels/octahedral_texel.h"
#include "kernels/probe_texel.h"

layout(push_constant, scalar) uniform Push {
    BlendPush push;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayWeights {
    GpuRayWeight at[];
};

const int kProbes = 4;

void store(int probe, int texel, vec2 newMoments) {
    const int size = probegiVolume.visibilityTexels;
    const ivec3 cell = gpuProbeCell(probe, probegiVolume.counts);
    const ivec2 tile = gpuTileOrigin(cell, size);
    const ivec2 at = ivec2(texel % size, texel / size);
    const vec2 old = imageLoad(visibilityImage, ivec3(tile + at, cell.z)).rg;
    const vec4 stored = vec4(unpackMoments(blendVisibilityTexel(packMoments(old), newMoments, push.visibilityHysteresis,
                                                                push.ditherSeed, uint(probe * size * size + texel))),
                             0.0, 0.0);
    imageStore(visibilityImage, ivec3(tile + at, cell.z), stored);
    for (int copy = 0; copy < 3; ++copy) {
        const ivec2 border = octBorderTexel(at.x, at.y, size, copy);
        if (border != at) imageStore(visibilityImage, ivec3(tile + border, cell.z), stored);
    }
}

void main() {
    const int texels = probegiVolume.visibilityTexels * probegiVolume.visibilityTexels;
    const int texel = int(gl_WorkGroupID.y * gl_WorkGroupSize.x + gl_LocalInvocationID.x);
    if (texel >= texels) return;
    const int firstProbe = int(blockIndex()) * kProbes;
    vec2 sum[kProbes];
    for (int p = 0; p < kProbes; ++p) sum[p] = vec2(0.0);
    const uint count = Uints(push.visibilityCounts).at[texel];
    for (uint k = 0; k < count; ++k) {
        const GpuRayWeight entry = RayWeights(push.visibilityWeights).at[k * texels + texel];
        for (int p = 0; p < kProbes; ++p) {
            // Probes beyond the last repeat it: their result is not stored.
            const int probe = min(firstProbe + p, push.probes - 1);
            const float distance = safeDistance(RayData(push.rayData).at[probe * push.rays + int(entry.ray)].distance);
            const float d = visibilityDistance(distance, push.maxDistance);
            sum[p] += entry.weight * vec2(d, d * d);
        }
    }
    for (int p = 0; p < kProbes; ++p)
        if (firstProbe + p < push.probes) store(firstProbe + p, texel, sum[p]);
}
