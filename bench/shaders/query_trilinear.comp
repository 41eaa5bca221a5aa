// Baseline of the query, and its lower limit: eight probes with trilinear weights only and no leak guard, so that light
// leaks through every wall.
#include "vulkan/shaders/volume.glsl"

#include "kernels/abi/gpu_passes.h"

#include "field_query.glsl"

vec3 queryIrradiance(FieldQuery q) {
    const Access access = probegiAccess();
    const Volume v = probegiField.volumes[0];
    const vec3 position = clampToVolume(v, q.position);
    const vec3 local = gridCoordinates(v, position);
    const vec3 base = cageBase(v, local);
    const vec3 alpha = cageAlpha(local, base);
    const vec2 texel = irradiancePoint(access, q.normal);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        const vec3 stored = storedIrradiance(access, probeSlot(v, ivec3(base) + corner), texel);
        const vec3 share = mix(1.0 - alpha, alpha, vec3(corner));
        sum += share.x * share.y * share.z *
               vec3(decodeToBlendSpace(stored.x), decodeToBlendSpace(stored.y), decodeToBlendSpace(stored.z));
    }
    return sum * sum * kPi;
}
