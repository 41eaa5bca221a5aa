#include "kernels/probe/probe_texel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace probegi::kernels {
namespace {

constexpr int kFrames = 4000;

vec3 storedBy(uvec3 bits) {
    return {unpackHalf(bits.x), unpackHalf(bits.y), unpackHalf(bits.z)};
}

// Mean of one stored texel over frames; the dither of a half float, 2^-10, leaves an error of 2^-11 / sqrt(frames).
vec3 meanTexel(vec3 old, vec3 now, BlendRule rule, bool linear) {
    glm::dvec3 sum(0.0);
    for (uint frame = 0; frame < kFrames; ++frame)
        sum += glm::dvec3(storedBy(blendIrradianceTexel(old, now, rule, linear, hashUint(frame), 77)));
    return vec3(sum / double(kFrames));
}

TEST(ProbeTexel, irradianceIsStoredAsItsFifthRoot) {
    const vec3 stored = storedBy(blendIrradianceTexel(vec3(9.0f), {32, 1, 0}, {0, 0, 0}, false, 1, 2));
    EXPECT_EQ(stored.z, 0.0f);
    EXPECT_NEAR(stored.x, 2, 2e-3);
    EXPECT_NEAR(stored.y, 1, 1e-3);
}

TEST(ProbeTexel, blendsInTheSpaceAskedFor) {
    const vec3 old(2, 1, 0.5f), now(1, 1, 1);
    const vec3 encoded = meanTexel(old, now, {0.75f, 0, 0}, false), linear = meanTexel(old, now, {0.75f, 0, 0}, true);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(encoded[c], 0.75 * old[c] + 0.25, 4e-5);
        EXPECT_NEAR(linear[c], std::pow(0.75 * std::pow(double(old[c]), 5) + 0.25, 0.2), 4e-5);
    }
}

TEST(ProbeTexel, greysStayGreyAndFramesAndTexelsDiffer) {
    int different = 0;
    for (uint i = 0; i < 100; ++i) {
        const uvec3 bits = blendIrradianceTexel(vec3(0.0f), vec3(0.3f), {0, 0, 0}, false, i, 5);
        EXPECT_TRUE(bits.x == bits.y && bits.y == bits.z);
        different += bits.x != blendIrradianceTexel(vec3(0.0f), vec3(0.3f), {0, 0, 0}, false, i, 6).x ? 1 : 0;
    }
    EXPECT_GT(different, 5);
}

TEST(ProbeTexel, momentsComeBack) {
    EXPECT_EQ(unpackMoments(0xffff0000u), vec2(0, 1));
    EXPECT_EQ(unpackMoments(0x0000ffffu), vec2(1, 0));
    for (uint low = 0; low < 0x10000u; ++low) {
        const uint bits = low | (0xffffu - low) << 16u;
        ASSERT_EQ(packMoments(unpackMoments(bits)), bits);
    }
}

TEST(ProbeTexel, visibilityKeepsItsShareOfTheOld) {
    const uint old = packMoments({0.5f, 0.25f});
    glm::dvec2 sum(0.0);
    for (uint frame = 0; frame < kFrames; ++frame)
        sum += glm::dvec2(unpackMoments(blendVisibilityTexel(old, {0.1f, 0.9f}, 0.75f, hashUint(frame), 3)));
    EXPECT_NEAR(sum.x / kFrames, 0.75 * unpackMoments(old).x + 0.25 * 0.1, 1e-6);
    EXPECT_NEAR(sum.y / kFrames, 0.75 * unpackMoments(old).y + 0.25 * 0.9, 1e-6);
    EXPECT_EQ(unpackMoments(blendVisibilityTexel(old, {1, 0}, 0, 1, 2)), vec2(1, 0));
}

}  // namespace
}  // namespace probegi::kernels
