#pragma once

#include <probegi/vulkan.h>

#include <list>
#include <vulkan/vulkan_raii.hpp>

/// A minimal stand-in for the engine's allocator: large blocks, each filled from front to back and reused once it is
/// empty. callbacks() exposes it to ProbeGI.
class MemoryPool {
public:
    MemoryPool(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device);

    probegi::vulkan::Allocator callbacks();
    VkResult allocate(const VkMemoryRequirements& needs, probegi::vulkan::MemoryUse use,
                      probegi::vulkan::Allocation& out);
    void free(const probegi::vulkan::Allocation& allocation);

    int allocations() const;  ///< currently alive
    std::size_t bytesUsed() const;
    std::size_t bytesOfBlocks() const;

private:
    struct Block {
        vk::raii::DeviceMemory memory{nullptr};
        std::uint32_t type = 0;
        VkDeviceSize size = 0, used = 0;
        std::byte* mapped = nullptr;
        int alive = 0;
    };
    std::uint32_t memoryType(std::uint32_t allowed, probegi::vulkan::MemoryUse use) const;
    Block& blockFor(const VkMemoryRequirements& needs, std::uint32_t type);

    const vk::raii::Device& m_device;
    vk::PhysicalDeviceMemoryProperties m_properties;
    VkDeviceSize m_granularity;
    std::list<Block> m_blocks;
};
