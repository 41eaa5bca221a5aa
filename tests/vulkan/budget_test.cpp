// Budgets of recorded updates: the books choose while the GPU works, and hear of it late.
#include <algorithm>
#include <cmath>

#include "support/field_setup.h"
#include "vulkan/engine.h"
#include "vulkan/field/gpu_field_impl.h"
#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

namespace probegi::test {

namespace {

using vulkan::GpuField;

class VulkanBudget : public testing::Test {
protected:
    void SetUp() override { hooks().reset(); }
    vulkan::Device adopt() { return *vulkan::Device::adopt(log, engine.adoptDesc()); }
    UpdateBudget probes(int count) const {
        UpdateBudget budget;
        budget.rays =
            std::int64_t(count) * (world.desc.raysPerProbe + world.desc.fixedRays + world.desc.emitterSamples);
        return budget;
    }

    SmallWorld world;
    LogBook log;
    Engine engine;
};

}  // namespace

TEST_F(VulkanBudget, probesPauseAfterTheGpuHasToldOfThem) {
    const vulkan::Device device = adopt();
    GpuField field = GpuField::create(device, world.desc, world.desc).value();
    field.control().setBudget(probes(8)).value();
    // The same light in all directions, always.
    const std::vector<RayDatum> light(8 * 16, {glm::vec3(1), 1.0f});
    const std::vector<FixedRayDatum> fixed(8 * std::size_t(world.desc.fixedRays), {1.0f, 0.0f, 1.0f});
    const EngineBuffer rays = engine.makeBuffer(std::span<const RayDatum>(light)),
                       fixedRays = engine.makeBuffer(std::span<const FixedRayDatum>(fixed));
    engine.run([&](VkCommandBuffer commands) { field.recordClear(commands).value(); });
    EXPECT_TRUE(field.impl().passes.progress().empty());
    std::vector<int> updates(18, 0);
    for (int frame = 0; frame < 40; ++frame) {
        EXPECT_LE(field.control().tasks().size(), 8u);
        for (const ProbeTask& task : field.control().tasks()) ++updates[task.slot];
        engine.run([&](VkCommandBuffer commands) {
            const auto recorded = field.recordUpdate(commands, rays.range(), fixedRays.range());
            EXPECT_TRUE(recorded) << recorded.error().message;
        });
    }
    EXPECT_GE(*std::min_element(updates.begin(), updates.end()), 8);
    EXPECT_EQ(field.control().tasks().size(), 2u) << "all have converged: those that waited longest";
    for (const auto& told : field.impl().passes.progress()) {
        EXPECT_GE(told.noise, 0.0f);
        EXPECT_LE(told.lag, 0.005f);
    }
    field.control().notify(FieldEvent::largeLightChange);
    EXPECT_EQ(field.control().tasks().size(), 8u);
    engine.run(
        [&](VkCommandBuffer commands) { EXPECT_TRUE(field.recordUpdate(commands, rays.range(), fixedRays.range())); });
}

// Where the GPU decides who sleeps, it tells of those too, so that the budget goes to others.
TEST_F(VulkanBudget, sleepersPauseAsWell) {
    world.desc.volumes[0].counts = {8, 8, 8};
    world.desc.volumes[0].origin = world.pose.bounds.lower + 0.03f * world.pose.bounds.size();
    world.desc.volumes[0].spacing = 0.94f * world.pose.bounds.size() / glm::vec3(7);
    world.desc.probeStates = true;
    const vulkan::Device device = adopt();
    GpuField field = GpuField::create(device, world.desc, world.desc).value();
    auto scene = vulkan::GpuScene::create(log, device, world.scene, world.pose).value();
    auto lighting = vulkan::GpuLighting::create(device, world.lighting).value();
    field.control().setBudget(probes(200)).value();
    engine.run([&](VkCommandBuffer commands) {
        scene.recordUpload(commands).value();
        lighting.recordUpload(commands).value();
        field.recordClear(commands).value();
    });
    std::vector<int> chosen(512, 0);
    for (int frame = 0; frame < 6; ++frame) {
        EXPECT_LE(field.control().tasks().size(), 200u);
        for (const ProbeTask& task : field.control().tasks()) ++chosen[task.slot];
        engine.run([&](VkCommandBuffer commands) {
            const auto recorded = field.recordUpdate(commands, scene, lighting);
            EXPECT_TRUE(recorded) << recorded.error().message;
        });
    }
    int asleep = 0, known = 0;
    for (std::size_t slot = 0; slot < 512; ++slot) {
        const auto& told = field.impl().passes.progress()[slot];
        asleep += told.noise == 0 && told.confidence == 0;
        known += told.noise >= 0;
        EXPECT_EQ(told.noise >= 0, chosen[slot] > 0) << slot;
    }
    EXPECT_EQ(known, 512) << "all had their turn";
    EXPECT_GT(asleep, 30) << "in the middle of the box";
    EXPECT_LT(asleep, 400);
}

}  // namespace probegi::test
