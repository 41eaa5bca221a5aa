#include "vulkan/device/memory.h"

#include <algorithm>
#include <vulkan/vulkan_format_traits.hpp>

#include "vulkan/device/device_impl.h"
#include "vulkan/device/errors.h"

namespace probegi::vulkan {

namespace {

vk::MemoryPropertyFlags propertiesFor(MemoryUse use) {
    using Flag = vk::MemoryPropertyFlagBits;
    switch (use) {
        case MemoryUse::device:
            return Flag::eDeviceLocal;
        case MemoryUse::upload:
            return Flag::eHostVisible | Flag::eHostCoherent;
        case MemoryUse::readback:
            return Flag::eHostVisible | Flag::eHostCoherent | Flag::eHostCached;
    }
    return {};
}

// The first type with all required properties; cached memory is optional.
std::uint32_t memoryType(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                         vk::MemoryPropertyFlags wanted) {
    for (const auto properties : {wanted, wanted & ~vk::MemoryPropertyFlags(vk::MemoryPropertyFlagBits::eHostCached),
                                  wanted & ~vk::MemoryPropertyFlags(vk::MemoryPropertyFlagBits::eDeviceLocal)})
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
            if ((allowed >> i & 1u) && (memory.memoryTypes[i].propertyFlags & properties) == properties) return i;
    throw vk::OutOfDeviceMemoryError("no memory type fits");
}

void allocateOwn(const Device::Impl& device, const VkMemoryRequirements& needs, MemoryUse use, bool deviceAddress,
                 Allocation& out) {
    const auto& properties = device.memoryProperties;
    const std::uint32_t type = memoryType(properties, needs.memoryTypeBits, propertiesFor(use));
    // Some drivers crash if asked for more.
    if (needs.size > properties.memoryHeaps[properties.memoryTypes[type].heapIndex].size)
        throw vk::OutOfDeviceMemoryError("more than the whole heap");
    const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
    const vk::MemoryAllocateInfo info(needs.size, type, deviceAddress ? &flags : nullptr);
    vk::raii::DeviceMemory memory(device.device, info);
    if (use != MemoryUse::device) out.mapped = memory.mapMemory(0, VK_WHOLE_SIZE);
    out.memory = memory.release();
}

vk::SharingMode sharingMode(const Device::Impl& device) {
    return device.sharing.empty() ? vk::SharingMode::eExclusive : vk::SharingMode::eConcurrent;
}

vk::raii::Buffer makeBuffer(const Device::Impl& device, std::size_t bytes, vk::BufferUsageFlags usage) {
    if (bytes > device.maxBufferBytes) throw vk::OutOfDeviceMemoryError("larger than any buffer");
    return {device.device, vk::BufferCreateInfo({}, bytes, usage, sharingMode(device), device.sharing)};
}

vk::raii::Image makeImage(const Device::Impl& device, vk::Format format, vk::Extent2D size, std::uint32_t layers) {
    using Usage = vk::ImageUsageFlagBits;
    const auto usage = Usage::eStorage | Usage::eSampled | Usage::eTransferSrc | Usage::eTransferDst;
    const auto most =
        device.physical.getImageFormatProperties(format, vk::ImageType::e2D, vk::ImageTiling::eOptimal, usage);
    const VkDeviceSize bytes = VkDeviceSize(size.width) * size.height * layers * vk::blockSize(format);
    if (bytes > most.maxResourceSize) throw vk::OutOfDeviceMemoryError("larger than any image");
    return {device.device, vk::ImageCreateInfo({}, vk::ImageType::e2D, format, vk::Extent3D(size, 1), 1, layers,
                                               vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage,
                                               sharingMode(device), device.sharing)};
}

}  // namespace

Memory::Memory(const Device::Impl& device, const VkMemoryRequirements& needs, MemoryUse use, bool deviceAddress) {
    if (device.allocator.allocate) {
        const VkResult result = device.allocator.allocate(needs, use, m_allocation);
        if (result != VK_SUCCESS) vk::throwResultException(vk::Result(result), "the engine's allocator");
        if (!m_allocation.memory || (use != MemoryUse::device && !m_allocation.mapped)) {
            device.allocator.free(m_allocation);
            throw Failure(ErrorCode::invalidArgument,
                          m_allocation.memory ? "the engine's allocator gave upload or readback memory that "
                                                "is not mapped; Allocation::mapped must point to it"
                                              : "the engine's allocator succeeded but gave no memory");
        }
    } else {
        allocateOwn(device, needs, use, deviceAddress, m_allocation);
    }
    m_device = &device;
}

Memory::~Memory() {
    if (!m_device) return;
    if (m_device->allocator.allocate) {
        m_device->allocator.free(m_allocation);
    } else {
        m_device->device.getDispatcher()->vkFreeMemory(*m_device->device, m_allocation.memory, nullptr);
    }
}

Buffer::Buffer(const Device::Impl& device, const char* name, std::size_t bytes, vk::BufferUsageFlags usage,
               MemoryUse use)
    : m_buffer(makeBuffer(device, std::max<std::size_t>(bytes, 16), usage)), m_bytes(std::max<std::size_t>(bytes, 16)) {
    const bool addressed = bool(usage & vk::BufferUsageFlagBits::eShaderDeviceAddress);
    m_memory = Memory(device, m_buffer.getMemoryRequirements(), use, addressed);
    m_buffer.bindMemory(m_memory.allocation().memory, m_memory.allocation().offset);
    if (addressed) m_address = device.device.getBufferAddress(vk::BufferDeviceAddressInfo(*m_buffer));
    device.setName(vk::ObjectType::eBuffer, std::uint64_t(VkBuffer(*m_buffer)), name);
}

Image::Image(const Device::Impl& device, const char* name, vk::Format format, vk::Extent2D size, std::uint32_t layers)
    : m_image(makeImage(device, format, size, layers)), m_size(size), m_layers(layers) {
    const VkMemoryRequirements needs = m_image.getMemoryRequirements();
    m_memory = Memory(device, needs, MemoryUse::device, false);
    m_bytes = needs.size;
    m_image.bindMemory(m_memory.allocation().memory, m_memory.allocation().offset);
    m_view = vk::raii::ImageView(device.device,
                                 vk::ImageViewCreateInfo({}, *m_image, vk::ImageViewType::e2DArray, format, {},
                                                         {vk::ImageAspectFlagBits::eColor, 0, 1, 0, layers}));
    device.setName(vk::ObjectType::eImage, std::uint64_t(VkImage(*m_image)), name);
}

}  // namespace probegi::vulkan
