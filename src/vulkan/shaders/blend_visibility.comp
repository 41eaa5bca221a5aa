// Distance moments of all probes from the frame's sparse weights, then hysteresis, dithered storage and the border
// (DDGI paper, section 2.3). A work group computes all texels of kProbes probes. Their distances are read once into
// shared memory, interleaved by probe, so that a weight needs one load for all probes.
#include "filter.glsl"
#include "ray_data.glsl"
#include "tasks.glsl"
#include "volume.glsl"

#include "kernels/abi/gpu_passes.h"
#include "kernels/blend/probe_blend.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/probe_texel.h"

layout(push_constant, scalar) uniform Push {
    BlendPush push;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayWeights {
    GpuRayWeight at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TexelRays {
    GpuTexelRays at[];
};

const int kProbes = kVisibilityGroupProbes;
const int kRays = 256;  // in shared memory at a time

shared vec4 distances[kRays];  // as fractions of the farthest; a component per probe

void store(ProbeTask task, int texel, float evidence, vec2 newMoments) {
    const int size = probegiField.visibilityTexels;
    const ivec3 place = poolTile(probegiField.tiles, int(task.slot));
    const ivec2 tile = tileOrigin(place, size);
    const uint number = uint(probeNumber(probegiField.volumes[task.volume], int(task.slot)));
    const ivec2 at = ivec2(texel % size, texel / size);
    const vec2 old = imageLoad(visibilityImage, ivec3(tile + at, place.z)).rg;
    float kept = isNew(ProbeFilters(push.filters).at[task.slot]) ? 0.0 : push.visibilityHysteresis;
    if (push.steps != uvec2(0u)) kept = ProbeSteps(push.steps).at[task.slot].visibilityKept;
    const vec4 stored =
        vec4(unpackMoments(blendVisibilityTexel(packMoments(old), newMoments, keptMoments(kept, evidence),
                                                push.ditherSeed, number * uint(size * size) + uint(texel))),
             0.0, 0.0);
    imageStore(visibilityImage, ivec3(tile + at, place.z), stored);
    for (int copy = 0; copy < 3; ++copy) {
        const ivec2 border = octBorderTexel(at.x, at.y, size, copy);
        if (border != at) imageStore(visibilityImage, ivec3(tile + border, place.z), stored);
    }
}

// Loads the group's rays from `first` on. Tasks beyond the last repeat it; their results are not stored.
void loadDistances(int firstTask, int first) {
    Tasks list = Tasks(push.tasks);
    const int last = int(list.counts.tasks) - 1;
    float farthest[kProbes];
    for (int p = 0; p < kProbes; ++p)
        farthest[p] = probegiField.volumes[list.at[min(firstTask + p, last)].volume].maxDistance;
    const int count = min(kRays, push.rays - first);
    for (int i = int(gl_LocalInvocationID.x); i < count; i += int(gl_WorkGroupSize.x)) {
        vec4 d;
        for (int p = 0; p < kProbes; ++p) {
            const int task = min(firstTask + p, last);
            const RayDatum datum = rayDatumAt(push.rayData, push.packedRays != 0, uint(task * push.rays + first + i));
            const float distance = safeDistance(datum.distance);
            const bool backface = hitBackface(distance, datum.radiance.x);
            d[p] = visibilityDistance(backface ? distance : abs(distance), farthest[p]);
        }
        distances[i] = d;
    }
}

void main() {
    const int texels = probegiField.visibilityTexels * probegiField.visibilityTexels;
    const int firstTask = int(blockIndex()) * kProbes;
    Tasks list = Tasks(push.tasks);
    const int tasks = int(list.counts.tasks);
    for (int firstTexel = 0; firstTexel < texels; firstTexel += int(gl_WorkGroupSize.x)) {
        const int texel = firstTexel + int(gl_LocalInvocationID.x);
        GpuTexelRays seen = GpuTexelRays(0u, 0.0);
        if (texel < texels) seen = TexelRays(push.visibilityRays).at[texel];
        vec4 mean = vec4(0.0), meanSquare = vec4(0.0);
        uint k = 0;
        for (int first = 0; first < push.rays; first += kRays) {
            if (firstTexel == 0 || push.rays > kRays) {
                barrier();
                loadDistances(firstTask, first);
                barrier();
            }
            for (; k < seen.count; ++k) {
                const GpuRayWeight entry = RayWeights(push.visibilityWeights).at[k * texels + texel];
                const int ray = int(entry.ray) - first;
                if (ray >= kRays) break;  // entries are sorted by ray
                const vec4 d = distances[ray];
                mean += entry.weight * d;
                meanSquare += entry.weight * (d * d);
            }
        }
        for (int p = 0; p < kProbes; ++p)
            if (texel < texels && firstTask + p < tasks)
                store(list.at[firstTask + p], texel, seen.evidence, vec2(mean[p], meanSquare[p]));
    }
}
