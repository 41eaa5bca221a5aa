#pragma once

#include <cstddef>
#include <span>

#include "probegi/vulkan.h"
#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// A piece of GPU memory: from the engine's allocator, or its own VkDeviceMemory. Throws.
class Memory {
public:
    Memory() = default;
    Memory(const Device::Impl& device, const VkMemoryRequirements& needs, MemoryUse use, bool deviceAddress);
    Memory(Memory&& other) noexcept { swap(other); }
    Memory& operator=(Memory&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Memory();

    const Allocation& allocation() const noexcept { return m_allocation; }

private:
    void swap(Memory& other) noexcept {
        std::swap(m_device, other.m_device);
        std::swap(m_allocation, other.m_allocation);
    }
    const Device::Impl* m_device = nullptr;
    Allocation m_allocation;
};

/// A buffer with memory and, depending on its usage, an address. Throws Vulkan-Hpp's exceptions.
class Buffer {
public:
    Buffer() = default;
    /// 0 `bytes` makes a buffer of 16, since Vulkan has no empty ones.
    Buffer(const Device::Impl& device, const char* name, std::size_t bytes, vk::BufferUsageFlags usage,
           MemoryUse use = MemoryUse::device);

    vk::Buffer handle() const noexcept { return *m_buffer; }
    VkDeviceAddress address() const noexcept { return m_address; }
    std::size_t bytes() const noexcept { return m_bytes; }
    explicit operator bool() const noexcept { return m_bytes != 0; }
    /// The mapped bytes of an upload or readback buffer.
    template <class T>
    std::span<T> mapped() const noexcept {
        return {static_cast<T*>(m_memory.allocation().mapped), m_bytes / sizeof(T)};
    }

private:
    Memory m_memory;
    vk::raii::Buffer m_buffer{nullptr};
    VkDeviceAddress m_address = 0;
    std::size_t m_bytes = 0;
};

/// A two-dimensional array image with one view of all layers.
class Image {
public:
    Image() = default;
    Image(const Device::Impl& device, const char* name, vk::Format format, vk::Extent2D size, std::uint32_t layers);

    vk::Image handle() const noexcept { return *m_image; }
    vk::ImageView view() const noexcept { return *m_view; }
    vk::Extent2D size() const noexcept { return m_size; }
    std::uint32_t layers() const noexcept { return m_layers; }
    std::size_t bytes() const noexcept { return m_bytes; }  ///< of memory, as required by the driver

private:
    Memory m_memory;
    vk::raii::Image m_image{nullptr};
    vk::raii::ImageView m_view{nullptr};
    vk::Extent2D m_size;
    std::uint32_t m_layers = 0;
    std::size_t m_bytes = 0;
};

/// Usage of a buffer that shaders access by address and copies write.
inline constexpr vk::BufferUsageFlags kAddressed = vk::BufferUsageFlagBits::eStorageBuffer |
                                                   vk::BufferUsageFlagBits::eShaderDeviceAddress |
                                                   vk::BufferUsageFlagBits::eTransferDst;

}  // namespace probegi::vulkan
