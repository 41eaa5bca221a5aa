#include "own_rays.h"

using namespace probegi;

namespace {

constexpr std::uint32_t kTraceProbes[] = {
#include "trace_probes.comp.inc"
};

struct TracePush {
    vk::DeviceAddress frame, rayData;
};

std::size_t rayCount(const FieldDesc& desc) {
    return std::size_t(probeCount(desc)) * desc.raysPerProbe;
}

vk::raii::PipelineLayout makeLayout(const vk::raii::Device& device, vk::DescriptorSetLayout set) {
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, sizeof(TracePush));
    return {device, vk::PipelineLayoutCreateInfo({}, set, push)};
}

}  // namespace

OwnRays::OwnRays(const EngineDevice& engine, MemoryPool& pool, const vulkan::GpuField& volume)
    : m_data(engine.device(), pool, rayCount(volume.desc()) * sizeof(PackedRayDatum)),
      m_probes(engine.device()),
      m_layout(makeLayout(engine.device(), m_probes.layout())),
      m_trace(makeComputePipeline(engine.device(), *m_layout, kTraceProbes)) {
    m_probes.write(volume);
}

void OwnRays::record(const vk::raii::CommandBuffer& commands, const vulkan::GpuField& volume,
                     vk::DeviceAddress frame) const {
    const TracePush push{frame, m_data.address};
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *m_trace);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *m_layout, 0, *m_probes, {});
    commands.pushConstants<TracePush>(*m_layout, vk::ShaderStageFlagBits::eCompute, 0, push);
    commands.dispatch(std::uint32_t((rayCount(volume.desc()) + 63) / 64), 1, 1);
    order(commands, kComputeUse, kComputeUse);  // recordUpdate() reads the data in compute shaders
}
