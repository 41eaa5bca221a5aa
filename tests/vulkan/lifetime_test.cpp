// Objects created and destroyed at run time leave nothing behind and report the right amount of memory.
#include "support/field_setup.h"
#include "support/probes.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

namespace probegi::test {

namespace {

class VulkanLifetime : public testing::Test {
protected:
    void SetUp() override { hooks().reset(); }
    void TearDown() override { hooks().reset(); }

    vulkan::Device open() {
        vulkan::OpenDesc desc;
        desc.getInstanceProcAddr = hookedLoader;
        return *vulkan::Device::open(log, desc);
    }

    // Runs `cycle` repeatedly, and expects as many objects and bytes at the end as after the first run.
    template <class Cycle>
    void expectNoGrowth(int cycles, const Cycle& cycle) {
        cycle();
        const auto objects = hooks().live;
        const int count = hooks().liveObjects();
        const VkDeviceSize bytes = hooks().allocatedBytes();
        for (int i = 0; i < cycles; ++i) {
            cycle();
            ASSERT_EQ(hooks().liveObjects(), count) << "cycle " << i << ": " << hooks().liveText();
        }
        EXPECT_EQ(hooks().live, objects);
        EXPECT_EQ(hooks().allocatedBytes(), bytes);
    }

    // Between the requested size and what drivers round it up to.
    void expectBytes(std::size_t reported, VkDeviceSize allocated, std::size_t pieces) {
        EXPECT_LE(reported, allocated);
        EXPECT_GE(reported + pieces * 65536, allocated);
        EXPECT_GE(double(reported), 0.5 * double(allocated));
    }

    LogBook log;
    const SmallWorld world;
};

}  // namespace

TEST_F(VulkanLifetime, aThousandVolumesLeaveNothing) {
    const vulkan::Device device = open();
    expectNoGrowth(1000, [&] {
        auto volume = vulkan::GpuField::create(device, world.desc, world.desc);
        ASSERT_TRUE(volume) << volume.error().message;
        const vulkan::GpuField moved = std::move(*volume);
    });
}

TEST_F(VulkanLifetime, scenesLightsAndFieldsLeaveNothing) {
    const vulkan::Device device = open();
    for (const vulkan::TracerKind kind : tracerKinds(device))
        expectNoGrowth(20, [&] {
            const auto scene = vulkan::GpuScene::create(log, device, world.scene, world.pose, {.tracer = kind});
            ASSERT_TRUE(scene) << scene.error().message;
        });
    expectNoGrowth(200, [&] { ASSERT_TRUE(vulkan::GpuLighting::create(device, world.lighting)); });
    expectNoGrowth(200, [&] { ASSERT_TRUE(vulkan::Profiler::create(device)); });
    const auto tracer = vulkan::makeTracer(log, device, world.scene, world.pose);
    ASSERT_TRUE(tracer);
    expectNoGrowth(100, [&] {
        auto field = vulkan::makeField(log, device, world.desc, world.desc);
        ASSERT_TRUE(field && field->update(**tracer, world.lighting));
        EXPECT_TRUE(finite(field->irradiance(world.query())));
        EXPECT_TRUE(finite(probeIrradiance(*field, 0, {0, 1, 0})));
    });
    auto field = vulkan::makeField(log, device, world.desc, world.desc);
    expectNoGrowth(20, [&] {
        ASSERT_TRUE(vulkan::renderPicture(log, device, **tracer, world.lighting, &*field, world.picture()));
    });
}

TEST_F(VulkanLifetime, assignmentFreesWhatWasThere) {
    const vulkan::Device device = open();
    auto volume = *vulkan::GpuField::create(device, world.desc, world.desc);
    auto scene = *vulkan::GpuScene::create(log, device, world.scene, world.pose);
    auto lighting = *vulkan::GpuLighting::create(device, world.lighting);
    auto profiler = *vulkan::Profiler::create(device);
    expectNoGrowth(10, [&] {
        volume = *vulkan::GpuField::create(device, world.desc, world.desc);
        scene = *vulkan::GpuScene::create(log, device, world.scene, world.pose);
        lighting = *vulkan::GpuLighting::create(device, world.lighting);
        profiler = *vulkan::Profiler::create(device);
    });
}

TEST_F(VulkanLifetime, devicesLeaveNothing) {
    expectNoGrowth(5, [&] {
        const vulkan::Device device = open();
        ASSERT_TRUE(vulkan::makeField(log, device, world.desc, world.desc));
    });
    EXPECT_EQ(hooks().liveObjects(), 0) << hooks().liveText();
}

TEST_F(VulkanLifetime, aVolumeReportsItsBytes) {
    const vulkan::Device device = open();
    FieldSetup desc = world.desc;
    desc.volumes[0].counts = {16, 12, 16};
    desc.irradianceTexels = 8;
    desc.visibilityTexels = 16;
    desc.raysPerProbe = 64;
    const VkDeviceSize before = hooks().allocatedBytes();
    const auto volume = vulkan::GpuField::create(device, desc, desc);
    ASSERT_TRUE(volume);
    const FieldMemory memory = volume->memory();
    expectBytes(memory.persistentBytes() + memory.scratchBytes, hooks().allocatedBytes() - before, 8);
    EXPECT_GE(memory.irradianceBytes, 16u * 12u * 16u * 10u * 10u * 8u);
    EXPECT_GE(memory.visibilityBytes, 16u * 12u * 16u * 18u * 18u * 4u);
}

TEST_F(VulkanLifetime, scenesAndLightsReportTheirBytes) {
    const vulkan::Device device = open();
    const Scene scene = *makeBuiltinScene("sphere");
    const ScenePose pose = poseAt(scene);
    for (const vulkan::TracerKind kind : tracerKinds(device)) {
        const VkDeviceSize before = hooks().allocatedBytes();
        auto uploaded = vulkan::GpuScene::create(log, device, scene, pose, {.tracer = kind});
        ASSERT_TRUE(uploaded);
        uploaded->releaseStaging();
        EXPECT_EQ(uploaded->bytes() <= hooks().allocatedBytes() - before, true);
        EXPECT_LE(hooks().allocatedBytes() - before, uploaded->bytes() + 24u * 4096u);
    }
    const VkDeviceSize before = hooks().allocatedBytes();
    auto lighting = vulkan::GpuLighting::create(device, world.lighting, 1000);
    lighting->releaseStaging();
    EXPECT_LE(lighting->bytes(), hooks().allocatedBytes() - before);
    EXPECT_LE(hooks().allocatedBytes() - before, lighting->bytes() + 3u * 4096u);
    EXPECT_GE(lighting->bytes(), 1000u * 52u);
}

}  // namespace probegi::test
