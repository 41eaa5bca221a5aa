#include <gtest/gtest.h>

#include "kernels/abi/dispatch.h"
#include "kernels/abi/field_constants.h"
#include "kernels/abi/gpu_passes.h"
#include "kernels/abi/gpu_scene.h"

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

// As in Recorder: rows of at most 32,768 groups, and enough groups.
TEST(Dispatch, groupsCoverEveryThread) {
    for (const uint count : {1u, 64u, 65u, 32768u * 64u, 32768u * 64u + 1u, 5000000u}) {
        const uvec3 groups = threadGroups(count);
        EXPECT_LE(groups.x, 32768u);
        EXPECT_EQ(groups.z, 1u);
        EXPECT_GE(std::uint64_t(groups.x) * groups.y * 64u, count);
        EXPECT_LT(std::uint64_t(groups.x) * (groups.y - 1) * 64u, count) << "no row too many";
    }
    EXPECT_EQ(blockGroups(100u, 3u), uvec3(100, 3, 1));
    EXPECT_EQ(blockGroups(70000u, 3u), uvec3(32768, 3, 3));
}

TEST(Dispatch, tasksAreCounted) {
    const GpuTaskCounts counts = countedTasks(100u, 160u, 4u, 64u);
    EXPECT_EQ(counts.tasks, 100u);
    EXPECT_EQ(counts.perTask, uvec3(2, 1, 1));
    EXPECT_EQ(counts.perRay, uvec3(250, 1, 1));
    EXPECT_EQ(counts.perLook, uvec3(7, 1, 1));
    EXPECT_EQ(counts.irradiance, uvec3(7, 1, 1)) << "16 probes and 64 texels a group";
    EXPECT_EQ(counts.visibility, uvec3(25, 1, 1)) << "4 probes a group";
    EXPECT_EQ(countedTasks(100u, 160u, 0u, 100u).irradiance, uvec3(7, 2, 1));
    EXPECT_EQ(countedTasks(0u, 160u, 4u, 64u).perRay, uvec3(0, 0, 1)) << "no task, no group";
}

}  // namespace
}  // namespace probegi::kernels
