#include "kernels/volume/placed_probe.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "kernels/volume/probe_offset.h"

namespace probegi::kernels {
namespace {

Volume someVolume() {
    Volume v{};
    v.origin = vec3(1, -2, 3);
    v.spacing = vec3(1.0f, 0.5f, 2.0f);
    v.inverseSpacing = 1.0f / v.spacing;
    v.minSpacing = 0.5f;
    v.counts = ivec3(4, 5, 6);
    v.orientation = vec4(0, 0, 0, 1);
    v.relocated = 1;
    return v;
}

TEST(PlacedProbe, offsetsComeBackWithinHalfAStep) {
    const Volume v = someVolume();
    for (float share = -0.5f; share <= 0.5f; share += 0.013f) {
        const vec3 offset = vec3(share, -share, 0.3f * share) * v.spacing;
        const vec3 back = probeOffset(v, int(withOffset(v, 0x55u, offset)));
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(back[axis], offset[axis], 0.5f * v.spacing[axis] * kLargestOffset / 127 + 1e-6f) << share;
    }
}

TEST(PlacedProbe, storedOffsetsAreExact) {
    const Volume v = someVolume();
    for (int byte = -127; byte <= 127; ++byte) {
        const uint word = 0x07u | (uint(byte) & 0xffu) << 8u | (uint(-byte) & 0xffu) << 16u;
        EXPECT_EQ(withOffset(v, word, probeOffset(v, int(word))), word) << byte;
    }
}

TEST(PlacedProbe, farOffsetsEndAtTheLargestByte) {
    EXPECT_EQ(packOffsetAxis(3.0f), 127u);
    EXPECT_EQ(packOffsetAxis(-3.0f), 0x81u);
    EXPECT_EQ(packOffsetAxis(0.0f), 0u);
}

TEST(PlacedProbe, theLowestByteSaysNothingOfThePlace) {
    const Volume v = someVolume();
    EXPECT_EQ(probeOffset(v, 0xff), vec3(0));
    EXPECT_EQ(withOffset(v, 0xabcdef12u, vec3(0)), 0x12u);
}

TEST(PlacedProbe, offsetsTurnWithTheVolume) {
    Volume v = someVolume();
    const uint word = withOffset(v, 0, vec3(0.25f, 0, 0) * v.spacing);
    const vec3 offset = probeOffset(v, int(word));
    EXPECT_EQ(placedPosition(v, {1, 0, 0}, word), vec3(2, -2, 3) + offset);
    const float half = std::sqrt(0.5f);  // x to z
    v.orientation = vec4(0, -half, 0, half);
    v.turned = 1;
    const vec3 turned = placedPosition(v, {1, 0, 0}, word);
    EXPECT_NEAR(turned.x, 1, 1e-5f);
    EXPECT_NEAR(turned.z, 3 + 1 + offset.x, 1e-5f);
    v.relocated = 0;
    EXPECT_EQ(placedPosition(v, {1, 0, 0}, word), probePosition(v, {1, 0, 0}));
}

}  // namespace
}  // namespace probegi::kernels
