// Grids, maps and ray counts at the ends of their ranges.
#include <random>

#include "support/field_setup.h"
#include "support/probes.h"
#include "support/vulkan_device.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

namespace probegi::test {

namespace {

FieldSetup smallest(glm::ivec3 counts) {
    FieldSetup desc;
    desc.volumes[0].counts = counts;
    desc.raysPerProbe = 8;
    desc.irradianceTexels = 4;
    desc.visibilityTexels = 4;
    return desc;
}

std::vector<RayDatum> randomRays(const FieldDesc& desc) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<RayDatum> rays(std::size_t(probeCount(desc)) * std::size_t(desc.raysPerProbe));
    for (RayDatum& d : rays) d = {{unit(random), unit(random), 2.0f * unit(random)}, 0.1f + 2.0f * unit(random)};
    return rays;
}

// Expects the same probes on both backends from the same rays.
void expectSameAsCpu(const FieldSetup& desc, std::span<const int> probes, const vulkan::Device& device = testDevice()) {
    auto made = vulkan::makeField(testContext(), device, desc, desc);
    ASSERT_TRUE(made) << made.error().message;
    Field onCpu = *Field::create(testContext(), desc, desc);
    const std::vector<RayDatum> rays = randomRays(desc);
    for (int i = 0; i < 2; ++i) {
        const auto updated = made->update(rays);
        ASSERT_TRUE(updated) << updated.error().message;
        ASSERT_TRUE(onCpu.update(rays));
    }
    for (const int probe : probes)
        for (const glm::vec3 d : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, -0.8f), glm::vec3(-0.48f, -0.6f, 0.64f)}) {
            const glm::vec3 e = probeIrradiance(*made, probe, d), wanted = probeIrradiance(onCpu, probe, d);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c], wanted[c], 2e-3f * wanted[c] + 1e-4f) << probe;
            const glm::vec2 m = probeDistanceMoments(*made, probe, d), same = probeDistanceMoments(onCpu, probe, d);
            EXPECT_NEAR(m.x, same.x, 2e-3f * same.x + 1e-4f) << probe;
            EXPECT_NEAR(m.y, same.y, 4e-3f * same.y + 1e-4f) << probe;
        }
    const FieldQuery query{
        probePosition(desc.volumes[0], probes.back()) - 0.3f * desc.volumes[0].spacing, {0, 1, 0}, {0, 1, 0}};
    const glm::vec3 e = made->irradiance(query), wanted = onCpu.irradiance(query);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c], wanted[c], 5e-3f * wanted[c] + 1e-3f);
}

}  // namespace

TEST(VulkanLimits, mapsOfEverySizeAgreeWithTheCpu) {
    for (const auto& [irradiance, visibility] : {std::pair{4, 4}, {6, 10}, {10, 6}, {18, 30}, {32, 64}}) {
        SCOPED_TRACE(irradiance);
        FieldSetup desc = smallest({3, 2, 4});
        desc.irradianceTexels = irradiance;
        desc.visibilityTexels = visibility;
        desc.raysPerProbe = 33;
        const int probes[] = {0, 7, 23};
        expectSameAsCpu(desc, probes);
    }
}

TEST(VulkanLimits, fewAndManyRaysAgreeWithTheCpu) {
    for (const int rays : {8, 9, 4095, 4096}) {
        SCOPED_TRACE(rays);
        FieldSetup desc = smallest({2, 2, 2});
        desc.raysPerProbe = rays;
        desc.irradianceTexels = 8;
        desc.visibilityTexels = 16;
        const int probes[] = {0, 3, 7};
        expectSameAsCpu(desc, probes);
    }
}

// More groups of four probes than one axis of a dispatch allows.
TEST(VulkanLimits, aQuarterOfAMillionProbesAgreeWithTheCpu) {
    const FieldSetup desc = smallest({96, 96, 33});
    const int last = probeCount(desc) - 1;
    ASSERT_GT(last, 4 * 65535);
    const int probes[] = {0, 131071, 131072, 262139, 262144, last - 1, last};
    expectSameAsCpu(desc, probes);
}

// A device with small images: two layers of 8 x 8 tiles of 6 texels.
TEST(VulkanLimits, poolsOfSeveralLayersAgreeWithTheCpuAndLargerOnesAreRefused) {
    hooks().reset();
    hooks().properties = [](VkPhysicalDeviceProperties& p) {
        p.limits.maxImageDimension2D = 64;
        p.limits.maxImageArrayLayers = 2;
    };
    LogBook log;
    {
        vulkan::OpenDesc open;
        open.getInstanceProcAddr = hookedLoader;
        const vulkan::Device device = *vulkan::Device::open(log, open);
        const int probes[] = {0, 7, 8, 63, 64, 65, 127};
        expectSameAsCpu(smallest({8, 4, 4}), probes, device);
        FieldSetup two = smallest({8, 4, 4});
        two.volumes.push_back({.origin = {20, 0, 0}, .counts = {2, 2, 2}});
        for (const FieldSetup& setup : {smallest({5, 5, 6}), two}) {
            const auto refused = vulkan::GpuField::create(device, setup);
            ASSERT_FALSE(refused);
            EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
            EXPECT_NE(refused.error().message.find("128"), std::string::npos) << refused.error().message;
        }
    }
    hooks().reset();
}

TEST(VulkanLimits, theLongestAxesWork) {
    for (const glm::ivec3 counts : {glm::ivec3(1024, 2, 2), glm::ivec3(2, 1024, 2), glm::ivec3(2, 2, 1024)}) {
        FieldSetup desc = smallest(counts);
        const int probes[] = {0, 2047, 4095};
        expectSameAsCpu(desc, probes);
    }
}

TEST(VulkanLimits, moreRaysThanCanBeNumberedAreRefused) {
    FieldSetup desc = smallest({128, 128, 64});
    desc.raysPerProbe = 2048;
    const auto volume = vulkan::GpuField::create(testDevice(), desc, desc);
    ASSERT_FALSE(volume);
    EXPECT_EQ(volume.error().code, ErrorCode::unsupported);
    EXPECT_NE(volume.error().message.find("raysPerProbe"), std::string::npos) << volume.error().message;
}

// Either there is enough memory or an error, but never an invalid request to the driver.
TEST(VulkanLimits, sixteenMillionProbesAreMadeOrRefused) {
    FieldSetup desc = smallest({256, 256, 256});
    for (const auto& [irradiance, visibility] : {std::pair{4, 4}, {8, 16}, {32, 64}}) {
        desc.irradianceTexels = irradiance;
        desc.visibilityTexels = visibility;
        const auto volume = vulkan::GpuField::create(testDevice(), desc, desc);
        if (volume) continue;
        EXPECT_EQ(volume.error().code, ErrorCode::outOfMemory);
        EXPECT_NE(volume.error().message.find("fewer probes"), std::string::npos) << volume.error().message;
    }
}

}  // namespace probegi::test
