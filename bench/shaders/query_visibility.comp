// Baseline of the query: the eight probes of the cage with their visibility, as in section 2.2 of the DDGI paper,
// without backface shares, counting and fallback.
#include "vulkan/shaders/volume.glsl"

#include "kernels/abi/gpu_passes.h"

#include "field_query.glsl"

vec3 queryIrradiance(FieldQuery q) {
    const Access access = probegiAccess();
    const Volume v = probegiField.volumes[0];
    const vec3 position = clampToVolume(v, q.position);
    const vec3 bias = visibilityBias(q.normal, q.toViewer, v.minSpacing, access.selfShadowBias, kRulesPaper);
    const vec3 local = gridCoordinates(v, position);
    const vec3 base = cageBase(v, local);
    const vec3 alpha = cageAlpha(local, base);
    const vec2 texel = irradiancePoint(access, q.normal);
    vec3 sum = vec3(0.0);
    float weightSum = 0.0;
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        const ivec3 cell = ivec3(base) + corner;
        const vec3 toProbe = probePlace(v, cell) - position;
        const vec3 fromProbe = bias - toProbe;
        const int slot = probeSlot(v, cell);
        const vec2 moments = probegiMoments(slot, fromProbe);
        const float visible =
            chebyshevWeight(moments.x, moments.y, length(fromProbe) * v.inverseMaxDistance, kRulesPaper);
        const float facing =
            backfaceWeight(cosineToProbe(dot(toProbe, q.normal), length(toProbe), v.minSpacing), kRulesPaper);
        const float weight = crushWeight(facing * visible) * trilinearFactor(float(corner.x), alpha.x) *
                             trilinearFactor(float(corner.y), alpha.y) * trilinearFactor(float(corner.z), alpha.z);
        const vec3 stored = storedIrradiance(access, slot, texel);
        sum += weight * vec3(decodeToBlendSpace(stored.x), decodeToBlendSpace(stored.y), decodeToBlendSpace(stored.z));
        weightSum += weight;
    }
    const vec3 root = sum / weightSum;
    return root * root * kPi;
}
