// Weights of the frame's rays for each texel, the same for all probes (DDGI paper, eq. 1 and its power-cosine form).
// One thread per texel. Irradiance weights are a dense matrix. Visibility weights are lists, since they fall so fast
// that nine rays in ten contribute less than a part in 10^8.
#include "common.glsl"

#include "kernels/abi/gpu_passes.h"
#include "kernels/blend/probe_blend.h"
#include "kernels/lookup/probe_query.h"
#include "kernels/probe/octahedral_texel.h"

layout(push_constant, scalar) uniform Push {
    WeightsPush push;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RayWeights {
    GpuRayWeight at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer TexelRays {
    GpuTexelRays at[];
};

void irradianceTexel(int texel) {
    const vec3 n = octTexelDirection(texel % push.irradianceSize, texel / push.irradianceSize, push.irradianceSize);
    Vec3s directions = Vec3s(push.directions);
    float sum = 0.0;
    for (int ray = 0; ray < push.rays; ++ray) sum += irradianceWeight(n, directions.at[ray]);
    const float scale = normalisingFactor(sum);
    for (int ray = 0; ray < push.rays; ++ray)
        Floats(push.irradianceWeights).at[ray * push.irradianceTexels + texel] =
            irradianceWeight(n, directions.at[ray]) * scale;
}

void visibilityTexel(int texel) {
    const vec3 n = octTexelDirection(texel % push.visibilitySize, texel / push.visibilitySize, push.visibilitySize);
    Vec3s directions = Vec3s(push.directions);
    float nearest = 0.0;
    for (int ray = 0; ray < push.rays; ++ray) nearest = max(nearest, dot(n, directions.at[ray]));
    const float leastCosine = leastVisibilityCosine(nearest, push.visibilityExponent);
    float sum = 0.0;
    for (int ray = 0; ray < push.rays; ++ray)
        if (dot(n, directions.at[ray]) > leastCosine)
            sum += visibilityWeight(n, directions.at[ray], push.visibilityExponent);
    // A texel without rays near it (few rays, high exponent) has no entries.
    uint count = 0;
    if (sum > 1e-20) {
        for (int ray = 0; ray < push.rays; ++ray) {
            if (!(dot(n, directions.at[ray]) > leastCosine)) continue;
            const float weight = visibilityWeight(n, directions.at[ray], push.visibilityExponent) / sum;
            RayWeights(push.visibilityWeights).at[count * push.visibilityTexels + texel] =
                GpuRayWeight(uint(ray), weight);
            ++count;
        }
    }
    const float evidence =
        push.rules == kRulesPaper ? 1.0 : visibilityEvidence(sum, push.visibilityExponent, push.rays);
    TexelRays(push.visibilityRays).at[texel] = GpuTexelRays(count, evidence);
}

void main() {
    const int texel = int(globalIndex());
    if (texel < push.irradianceTexels)
        irradianceTexel(texel);
    else if (texel < push.irradianceTexels + push.visibilityTexels)
        visibilityTexel(texel - push.irradianceTexels);
}
