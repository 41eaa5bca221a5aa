#pragma once

#include <probegi/vulkan.h>

#include "engine_device.h"
#include "memory_pool.h"
#include "own_rays.h"
#include "rooms.h"

/// What an engine adds to use ProbeGI: its device is adopted, and two probe volumes are updated in its command buffer.
/// One uses the library's tracer, the other the engine's rays; both must agree.
class GlobalIllumination {
public:
    GlobalIllumination(const probegi::Context& context, const EngineDevice& engine, MemoryPool& pool,
                       const FrameData& start);

    /// Call it once, in the first command buffer; when that has finished, the staging memory can be released.
    void recordUpload(const vk::raii::CommandBuffer& commands);
    void releaseStaging();
    /// One update of both volumes. `frame`: address of the same data, visible to compute shaders.
    void record(const vk::raii::CommandBuffer& commands, const FrameData& now, vk::DeviceAddress frame,
                probegi::vulkan::Profiler& profiler);
    void recordQuestions(const vk::raii::CommandBuffer& commands, vk::DeviceAddress questions, std::uint32_t count,
                         vk::DeviceAddress traced, vk::DeviceAddress own);

    const probegi::vulkan::Device& device() const { return m_device; }
    const probegi::vulkan::GpuField& volume() const { return m_traced; }
    void printMemory() const;

private:
    static probegi::vulkan::Device adopt(const probegi::Context& context, const EngineDevice& engine, MemoryPool& pool);

    FrameData m_start;
    probegi::Scene m_scene;
    probegi::vulkan::Device m_device;
    probegi::vulkan::GpuScene m_gpuScene;
    probegi::vulkan::GpuLighting m_lighting;
    probegi::vulkan::GpuField m_traced, m_own;
    OwnRays m_ownRays;
};
