#pragma once

#include <probegi/image.h>
#include <probegi/vulkan.h>

#include "engine_device.h"
#include "probe_set.h"
#include "resources.h"
#include "rooms.h"

/// The engine's renderer: a rasterised G-buffer, then one compute pass that shades it and queries the probes.
class Renderer {
public:
    /// `size`: of the G-buffer. The picture is twice as wide: without the probes on the left, with them on the right.
    Renderer(const EngineDevice& engine, MemoryPool& pool, vk::Extent2D size);

    /// Selects the volume to query. Do not call it while a frame is in flight.
    void useProbes(const probegi::vulkan::GpuField& volume) { m_probes.write(volume); }
    /// `frame`: address of FrameData.
    void recordGBuffer(const vk::raii::CommandBuffer& commands, vk::DeviceAddress frame) const;
    void recordShading(const vk::raii::CommandBuffer& commands, vk::DeviceAddress frame) const;
    void recordReadBack(const vk::raii::CommandBuffer& commands) const;
    /// The linear picture from recordReadBack(), once the command buffer has finished.
    probegi::HdrImage picture() const;

private:
    void writeSet(const vk::raii::Device& device);
    void makeGraphicsPipeline(const vk::raii::Device& device);

    vk::Extent2D m_size;
    GpuImage m_position, m_normal, m_albedo, m_depth, m_picture;
    GpuBuffer m_readBack;
    vk::raii::DescriptorPool m_descriptors;
    vk::raii::DescriptorSetLayout m_imageLayout;
    vk::raii::DescriptorSet m_imageSet;
    ProbeSet m_probes;
    vk::raii::PipelineLayout m_rasterLayout, m_shadeLayout;
    vk::raii::Pipeline m_raster, m_shade;
};
