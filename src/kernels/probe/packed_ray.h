// A ray's datum in 8 bytes, half of the memory traffic: radiance as Vulkan's E5B9G9R9 (three mantissas of 9 bits and
// the exponent of the largest), distance as a float. A back's lowest bit of distance says whether its surface has two
// sides, which the signs of a RayDatum's radiance say.
#ifndef PROBEGI_KERNELS_PACKED_RAY_H
#define PROBEGI_KERNELS_PACKED_RAY_H

#include "kernels/language.h"

KERNELS_BEGIN

// Largest radiance of the format: 511/512 of 2^16.
KERNEL_CONST float kMostPackedRadiance = 65408.0f;

// 2^n, -126 <= n <= 127.
KERNEL_FN float powerOfTwo(int n) {
    return uintBitsToFloat(uint(n + 127) << 23u);
}

// What is not above 0 becomes 0.
KERNEL_FN float packableRadiance(float x) {
    return x > 0.0f ? min(x, kMostPackedRadiance) : 0.0f;
}

// Rounded to nearest: within 1/512 of the largest channel; below 2^-25, 0.
KERNEL_FN uint packRadiance(vec3 radiance) {
    const vec3 c = vec3(packableRadiance(radiance.x), packableRadiance(radiance.y), packableRadiance(radiance.z));
    const float largest = max(c.x, max(c.y, c.z));
    int exponent = max(int(floatBitsToUint(largest) >> 23u) - 127, -16) + 16;
    if (floor(largest * powerOfTwo(24 - exponent) + 0.5f) > 511.0f) ++exponent;
    const float scale = powerOfTwo(24 - exponent);
    return uint(floor(c.x * scale + 0.5f)) | uint(floor(c.y * scale + 0.5f)) << 9u |
           uint(floor(c.z * scale + 0.5f)) << 18u | uint(exponent) << 27u;
}

KERNEL_FN vec3 unpackRadiance(uint bits) {
    const float scale = powerOfTwo(int(bits >> 27u) - 24);
    return scale * vec3(float(bits & 511u), float((bits >> 9u) & 511u), float((bits >> 18u) & 511u));
}

// The distance of a datum whose radiance has such a red channel.
KERNEL_FN float packRayDistance(float signedDistance, float signedRed) {
    const uint bits = floatBitsToUint(signedDistance);
    if ((bits & 0x80000000u) == 0u) return signedDistance;
    // Never a denormal, which arithmetic may take for 0.
    const uint magnitude = max(bits & 0x7ffffffeu, 0x00800000u);
    return uintBitsToFloat(0x80000000u | magnitude | floatBitsToUint(signedRed) >> 31u);
}

// Radiance as a RayDatum has it: negative from the back of a surface with two sides, where black is a tiny value.
KERNEL_FN vec3 unpackRayRadiance(uint bits, float packedDistance) {
    const vec3 radiance = unpackRadiance(bits);
    const bool twoSidedBack = (floatBitsToUint(packedDistance) & 0x80000001u) == 0x80000001u;
    return twoSidedBack ? -max(radiance, vec3(1e-30f)) : radiance;
}

// Of the radiance of such a back, which is packed without its sign.
KERNEL_FN vec3 unsignedRadiance(float signedDistance, vec3 signedRadiance) {
    return (floatBitsToUint(signedDistance) & 0x80000000u) != 0u ? abs(signedRadiance) : signedRadiance;
}

KERNELS_END

#endif
