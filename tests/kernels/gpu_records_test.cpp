#include <gtest/gtest.h>

#include "kernels/abi/gpu_passes.h"
#include "kernels/abi/gpu_scene.h"
#include "kernels/volume/gpu_volume.h"

namespace probegi::kernels {
namespace {

TEST(GpuScene, textureFlagsComeBack) {
    for (int wrapU = 0; wrapU < 3; ++wrapU)
        for (int wrapV = 0; wrapV < 3; ++wrapV)
            for (int uvSet = 0; uvSet < 2; ++uvSet)
                for (const bool nearest : {false, true}) {
                    const uint flags = packTextureFlags(wrapU, wrapV, nearest, uvSet);
                    EXPECT_EQ(textureWrapU(flags), wrapU);
                    EXPECT_EQ(textureWrapV(flags), wrapV);
                    EXPECT_EQ(textureNearest(flags), nearest);
                    EXPECT_EQ(textureUvSet(flags), uvSet);
                }
}

TEST(GpuScene, addressesCarry) {
    const auto sum = [](std::uint64_t a, std::uint64_t b) {
        const uvec2 s = addAddress({uint(a), uint(a >> 32)}, {uint(b), uint(b >> 32)});
        return std::uint64_t(s.y) << 32 | s.x;
    };
    EXPECT_EQ(sum(1, 2), 3u);
    EXPECT_EQ(sum(0xffffffffu, 1), 0x100000000u);
    EXPECT_EQ(sum(0x1ffffffffu, 0x2ffffffffu), 0x4fffffffeu);
    EXPECT_EQ(sum(0x500000000u, 0x7u), 0x500000007u);
}

TEST(GpuScene, texelsHaveRedInTheLowestByte) {
    for (int channel = 0; channel < 4; ++channel) EXPECT_EQ(texelCode(0x44332211u, channel), 0x11u * uint(channel + 1));
    EXPECT_EQ(texelCodes(0x44ff2211u), vec3(0x11, 0x22, 0xff));
}

TEST(GpuVolume, probesCountXFirst) {
    const ivec3 counts(3, 4, 5);
    int probe = 0;
    for (int z = 0; z < 5; ++z)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 3; ++x) EXPECT_EQ(gpuProbeCell(probe++, counts), ivec3(x, y, z));
}

// Maps of 8 texels with a border of one lie 10 apart.
TEST(GpuVolume, tilesHaveABorder) {
    EXPECT_EQ(gpuTileOrigin({0, 0, 9}, 8), ivec2(1, 1));
    EXPECT_EQ(gpuTileOrigin({2, 3, 9}, 8), ivec2(21, 31));
    // The centre of texel (4, 5) of that tile in an atlas of 100 x 50.
    const vec2 at = gpuAtlasCoordinates({2, 3, 0}, {4, 5}, 8, {0.01f, 0.02f});
    EXPECT_NEAR(at.x, 0.255f, 1e-6f);
    EXPECT_NEAR(at.y, 0.73f, 1e-6f);
}

}  // namespace
}  // namespace probegi::kernels
