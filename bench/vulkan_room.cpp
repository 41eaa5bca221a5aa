#include "vulkan_room.h"

#include <algorithm>

#include "vulkan/device/errors.h"
#include "vulkan/device/staging.h"

namespace probegi::bench {

using namespace vulkan;

namespace {

vk::raii::Pipeline makePipeline(const Device& device, std::span<const std::uint32_t> spirv) {
    const Device::Impl& impl = device.impl();
    const vk::raii::ShaderModule module(impl.device, vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    return {impl.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *impl.pipelines->layout().pipeline)};
}

}  // namespace

BenchPass::BenchPass(const Device& device, std::span<const std::uint32_t> spirv)
    : m_pipeline(makePipeline(device, spirv)) {}

void BenchPass::record(const Recorder& recorder, std::uint64_t count) const {
    const kernels::uvec3 groups = kernels::threadGroups(std::uint32_t(count));
    recorder.commands().bindPipeline(vk::PipelineBindPoint::eCompute, *m_pipeline, recorder.dispatcher());
    recorder.commands().dispatch(groups.x, groups.y, 1, recorder.dispatcher());
}

VulkanRoom::VulkanRoom(const RoomField& room, std::span<const RayDatum> rayData)
    : m_device(orThrow(Device::open(room.context()))),
      m_room(room),
      m_volume(m_device, room.desc()),
      m_profiler(orThrow(Profiler::create(m_device))) {
    const std::vector<RayDatum> rays(rayData.begin(), rayData.end());
    const std::vector<glm::vec3> directions(room.directions().begin(), room.directions().end());
    Staging staging;
    m_rayData = staging.add(m_device.impl(), "rays", rays);
    m_directions = staging.add(m_device.impl(), "directions", directions);
    staging.fill(m_device.impl());
    submitAndWait(m_device, [&](const Recorder& recorder) {
        staging.record(recorder);
        m_volume.recordClear(recorder, m_room.settings());
    });
}

UpdateFrame VulkanRoom::frame() const {
    return {.desc = m_room.desc(),
            .settings = m_room.settings(),
            .volumes = m_volume.volumes(),
            .tasks = m_room.tasks(),
            .directions = m_room.directions(),
            .hysteresis = {0.5f, 0.5f},
            .ditherSeed = 7};
}

std::vector<PassTime> VulkanRoom::run(const std::function<void(const Recorder&, Profiler&)>& passes) {
    submitAndWait(m_device, [&](const Recorder& recorder) {
        m_profiler.recordReset(recorder.commands());
        passes(recorder, m_profiler);
        recorder.orderAll();
    });
    return orThrow(m_profiler.read());
}

void VulkanRoom::clear() {
    submitAndWait(m_device, [&](const Recorder& recorder) { m_volume.recordClear(recorder, m_room.settings()); });
}

std::vector<PassTime> VulkanRoom::update() {
    return run([&](const Recorder& recorder, Profiler& profiler) {
        m_volume.recordUpdate(recorder, frame(), RayAddresses{.update = m_rayData.address()}, &profiler);
    });
}

double sumOf(const std::vector<PassTime>& passes) {
    double sum = 0;
    for (const PassTime& pass : passes) sum += pass.milliseconds;
    return sum;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

}  // namespace probegi::bench
