// What an update stores in a probe's texel: blend, dither, 16 bits. Every backend with the same means stores the same
// bits.
#ifndef PROBEGI_KERNELS_PROBE_TEXEL_H
#define PROBEGI_KERNELS_PROBE_TEXEL_H

#include "kernels/blend/probe_blend.h"
#include "kernels/probe/storage.h"

KERNELS_BEGIN

// The new bits of an irradiance texel, three half floats. `oldStored`: the stored (encoded) values; `newMean`: linear;
// `linearSpace`: blendLinear() instead of blendEncoded(); `texel`: probe * texels + y * size + x.
KERNEL_FN uvec3 blendIrradianceTexel(vec3 oldStored, vec3 newMean, BlendRule rule, bool linearSpace, uint frameSeed,
                                     uint texel) {
    const vec3 value =
        linearSpace ? blendLinear(oldStored, newMean, rule.hysteresis) : blendEncoded(oldStored, newMean, rule);
    // One dither for all three channels keeps greys grey.
    const uint dither = storageDither(frameSeed, texel) >> 19u;
    return uvec3(packHalfDithered(value.x, dither), packHalfDithered(value.y, dither),
                 packHalfDithered(value.z, dither));
}

// Stored bits -> mean and mean square of distance, as fractions of the farthest.
KERNEL_FN vec2 unpackMoments(uint stored) {
    return vec2(unpackUnorm16(stored & 0xffffu), unpackUnorm16(stored >> 16u));
}

// Bits of moments read as unorm, exactly.
KERNEL_FN uint packMoments(vec2 moments) {
    return uint(moments.x * 65535.0f + 0.5f) | uint(moments.y * 65535.0f + 0.5f) << 16u;
}

// The new bits of a visibility texel: mean in the low half, mean square in the high half.
KERNEL_FN uint blendVisibilityTexel(uint oldStored, vec2 newMoments, float hysteresis, uint frameSeed, uint texel) {
    const vec2 moments = mix(newMoments, unpackMoments(oldStored), hysteresis);
    const float dither = uintToUnit(storageDither(frameSeed ^ 0x5bd1e995u, texel));
    return packUnorm16Dithered(moments.x, dither) | packUnorm16Dithered(moments.y, dither) << 16u;
}

KERNELS_END

#endif
