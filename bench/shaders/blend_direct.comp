// Baseline of the blend: eq. 1 as in the paper, with a thread for each texel of each probe. Each loops over all rays of
// its probe and computes their weights on the fly: a cosine for irradiance, a power for visibility. The rest (encoding,
// hysteresis, dither, border) is the library's.
#include "vulkan/shaders/ray_data.glsl"
#include "vulkan/shaders/volume.glsl"

#include "kernels/abi/gpu_passes.h"
#include "kernels/probe/octahedral_texel.h"
#include "kernels/probe/probe_texel.h"

layout(push_constant, scalar) uniform Push {
    BlendPush push;
    uvec2 directions;  // vec3[ray]
    float visibilityExponent;
};

void storeIrradiance(int probe, ivec2 at, vec3 newMean) {
    const int size = probegiField.irradianceTexels;
    const ivec3 place = poolTile(probegiField.tiles, probe);
    const ivec2 tile = tileOrigin(place, size);
    const vec3 old = imageLoad(irradianceImage, ivec3(tile + at, place.z)).rgb;
    const BlendRule rule = BlendRule(push.irradianceHysteresis, push.significantChange, push.newDistribution);
    const uvec3 bits = blendIrradianceTexel(old, newMean, rule, push.linear != 0, push.ditherSeed,
                                            uint((probe * size + at.y) * size + at.x));
    const vec4 stored = vec4(unpackHalf(bits.x), unpackHalf(bits.y), unpackHalf(bits.z), 0.0);
    imageStore(irradianceImage, ivec3(tile + at, place.z), stored);
    for (int copy = 0; copy < 3; ++copy) {
        const ivec2 border = octBorderTexel(at.x, at.y, size, copy);
        if (border != at) imageStore(irradianceImage, ivec3(tile + border, place.z), stored);
    }
}

void storeVisibility(int probe, ivec2 at, vec2 newMoments) {
    const int size = probegiField.visibilityTexels;
    const ivec3 place = poolTile(probegiField.tiles, probe);
    const ivec2 tile = tileOrigin(place, size);
    const vec2 old = imageLoad(visibilityImage, ivec3(tile + at, place.z)).rg;
    const uint bits = blendVisibilityTexel(packMoments(old), newMoments, push.visibilityHysteresis, push.ditherSeed,
                                           uint((probe * size + at.y) * size + at.x));
    const vec4 stored = vec4(unpackMoments(bits), 0.0, 0.0);
    imageStore(visibilityImage, ivec3(tile + at, place.z), stored);
    for (int copy = 0; copy < 3; ++copy) {
        const ivec2 border = octBorderTexel(at.x, at.y, size, copy);
        if (border != at) imageStore(visibilityImage, ivec3(tile + border, place.z), stored);
    }
}

void blendIrradiance(int probe, ivec2 at) {
    const vec3 n = octTexelDirection(at.x, at.y, probegiField.irradianceTexels);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int ray = 0; ray < push.rays; ++ray) {
        const float weight = irradianceWeight(n, Vec3s(directions).at[ray]);
        const RayDatum d = RayData(push.rayData).at[probe * push.rays + ray];
        if (!hitBackface(safeDistance(d.distance), d.radiance.x))
            sum += weight * vec3(safeRadiance(d.radiance.x), safeRadiance(d.radiance.y), safeRadiance(d.radiance.z));
        weights += weight;
    }
    storeIrradiance(probe, at, sum * normalisingFactor(weights));
}

void blendVisibility(int probe, ivec2 at) {
    const vec3 n = octTexelDirection(at.x, at.y, probegiField.visibilityTexels);
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int ray = 0; ray < push.rays; ++ray) {
        const float weight = visibilityWeight(n, Vec3s(directions).at[ray], visibilityExponent);
        const float distance = safeDistance(RayData(push.rayData).at[probe * push.rays + ray].distance);
        const float d = visibilityDistance(distance, probegiField.volumes[0].maxDistance);
        sum += weight * vec2(d, d * d);
        weights += weight;
    }
    storeVisibility(probe, at, sum * normalisingFactor(weights));
}

// Irradiance of all probes, then visibility of all probes: with maps of 8x8 and 16x16 no group has both.
void main() {
    const int irradianceSize = probegiField.irradianceTexels;
    const int visibilitySize = probegiField.visibilityTexels;
    const int irradianceTexels = irradianceSize * irradianceSize;
    const int visibilityTexels = visibilitySize * visibilitySize;
    int index = int(globalIndex());
    if (index < probegiProbeCount() * irradianceTexels) {
        const int texel = index % irradianceTexels;
        blendIrradiance(index / irradianceTexels, ivec2(texel % irradianceSize, texel / irradianceSize));
        return;
    }
    index -= probegiProbeCount() * irradianceTexels;
    if (index >= probegiProbeCount() * visibilityTexels) return;
    const int texel = index % visibilityTexels;
    blendVisibility(index / visibilityTexels, ivec2(texel % visibilitySize, texel / visibilitySize));
}
