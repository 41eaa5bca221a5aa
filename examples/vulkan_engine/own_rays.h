#pragma once

#include <probegi/vulkan.h>

#include "engine_device.h"
#include "probe_set.h"
#include "resources.h"

/// Ray data that the engine traces in its own compute shader (shaders/trace_probes.comp).
class OwnRays {
public:
    /// Allocates for updates of `volume`, which must outlive this.
    OwnRays(const EngineDevice& engine, MemoryPool& pool, const probegi::vulkan::GpuField& volume);

    /// Traces the rays of the next update; its data is visible to compute shaders afterwards. `frame`: address of
    /// FrameData.
    void record(const vk::raii::CommandBuffer& commands, const probegi::vulkan::GpuField& volume,
                vk::DeviceAddress frame) const;
    probegi::vulkan::BufferRange data() const { return {m_data.address, m_data.bytes}; }

private:
    GpuBuffer m_data;
    ProbeSet m_probes;
    vk::raii::PipelineLayout m_layout;
    vk::raii::Pipeline m_trace;
};
