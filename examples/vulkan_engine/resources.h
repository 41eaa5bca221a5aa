#pragma once

#include <span>

#include "memory_pool.h"

/// Buffers, images and pipelines of the engine, with memory from its pool.

/// Memory from the pool, returned on destruction.
class PoolMemory {
public:
    PoolMemory(MemoryPool& pool, const VkMemoryRequirements& needs, probegi::vulkan::MemoryUse use);
    PoolMemory(const PoolMemory&) = delete;
    PoolMemory& operator=(const PoolMemory&) = delete;
    ~PoolMemory() { m_pool.free(m_allocation); }
    const probegi::vulkan::Allocation& operator*() const { return m_allocation; }

private:
    MemoryPool& m_pool;
    probegi::vulkan::Allocation m_allocation;
};

/// A storage buffer that shaders access by address.
struct GpuBuffer {
    GpuBuffer(const vk::raii::Device& device, MemoryPool& pool, vk::DeviceSize bytes,
              probegi::vulkan::MemoryUse use = probegi::vulkan::MemoryUse::device);
    template <class T>
    std::span<T> mapped() const {
        return {static_cast<T*>((*memory).mapped), bytes / sizeof(T)};
    }

    vk::DeviceSize bytes;
    vk::raii::Buffer buffer;
    PoolMemory memory;
    vk::DeviceAddress address;
};

/// A two-dimensional image and its view.
struct GpuImage {
    GpuImage(const vk::raii::Device& device, MemoryPool& pool, vk::Format format, vk::Extent2D size,
             vk::ImageUsageFlags usage);
    vk::ImageSubresourceRange range() const { return {aspect, 0, 1, 0, 1}; }

    vk::Format format;
    vk::ImageAspectFlags aspect;
    vk::raii::Image image;
    PoolMemory memory;
    vk::raii::ImageView view;
};

/// One side of a barrier: stages and their memory accesses.
struct Access {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 access;
};
inline constexpr Access kComputeUse{vk::PipelineStageFlagBits2::eComputeShader,
                                    vk::AccessFlagBits2::eShaderRead | vk::AccessFlagBits2::eShaderWrite};
inline constexpr Access kTransferWrite{vk::PipelineStageFlagBits2::eTransfer, vk::AccessFlagBits2::eTransferWrite};
inline constexpr Access kTransferRead{vk::PipelineStageFlagBits2::eTransfer, vk::AccessFlagBits2::eTransferRead};
inline constexpr Access kHostRead{vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead};

void order(const vk::raii::CommandBuffer& commands, Access before, Access after);
vk::ImageMemoryBarrier2 transition(const GpuImage& image, Access before, vk::ImageLayout from, Access after,
                                   vk::ImageLayout to);

vk::raii::DescriptorSetLayout makeSetLayout(const vk::raii::Device& device,
                                            std::span<const vk::DescriptorSetLayoutBinding> bindings);
vk::raii::Pipeline makeComputePipeline(const vk::raii::Device& device, vk::PipelineLayout layout,
                                       std::span<const std::uint32_t> code);
