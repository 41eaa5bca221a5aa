#include "memory_pool.h"

#include <algorithm>
#include <functional>
#include <numeric>

using namespace probegi::vulkan;

namespace {

constexpr VkDeviceSize kBlockBytes = 32 << 20;

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

}  // namespace

MemoryPool::MemoryPool(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device)
    : m_device(device),
      m_properties(physical.getMemoryProperties()),
      m_granularity(physical.getProperties().limits.bufferImageGranularity) {}

Allocator MemoryPool::callbacks() {
    return {.allocate = [this](const VkMemoryRequirements& needs, MemoryUse use,
                               Allocation& out) { return allocate(needs, use, out); },
            .free = [this](const Allocation& allocation) { free(allocation); }};
}

std::uint32_t MemoryPool::memoryType(std::uint32_t allowed, MemoryUse use) const {
    using Flag = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags wanted = use == MemoryUse::device ? vk::MemoryPropertyFlags(Flag::eDeviceLocal)
                                                                    : Flag::eHostVisible | Flag::eHostCoherent;
    for (std::uint32_t i = 0; i < m_properties.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (m_properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    throw vk::OutOfDeviceMemoryError("no memory type fits");
}

MemoryPool::Block& MemoryPool::blockFor(const VkMemoryRequirements& needs, std::uint32_t type) {
    for (Block& block : m_blocks)
        if (block.type == type && alignUp(block.used, needs.alignment) + needs.size <= block.size) return block;
    // ProbeGI accesses buffers by address, so all memory is allocated for that.
    const vk::MemoryAllocateFlagsInfo addressed(vk::MemoryAllocateFlagBits::eDeviceAddress);
    Block block;
    block.type = type;
    block.size = std::max(kBlockBytes, needs.size);
    block.memory = m_device.allocateMemory({block.size, type, &addressed});
    if (m_properties.memoryTypes[type].propertyFlags & vk::MemoryPropertyFlagBits::eHostVisible)
        block.mapped = static_cast<std::byte*>(block.memory.mapMemory(0, VK_WHOLE_SIZE));
    return m_blocks.emplace_back(std::move(block));
}

VkResult MemoryPool::allocate(const VkMemoryRequirements& wanted, MemoryUse use, Allocation& out) {
    VkMemoryRequirements needs = wanted;
    needs.alignment = std::max(needs.alignment, m_granularity);  // since buffers and images may be neighbours
    needs.size = alignUp(needs.size, m_granularity);
    try {
        Block& block = blockFor(needs, memoryType(needs.memoryTypeBits, use));
        out.memory = *block.memory;
        out.offset = alignUp(block.used, needs.alignment);
        out.mapped = block.mapped ? block.mapped + out.offset : nullptr;
        out.userData = &block;
        block.used = out.offset + needs.size;
        ++block.alive;
    } catch (const vk::SystemError& error) {  // callbacks must not throw
        return VkResult(error.code().value());
    }
    return VK_SUCCESS;
}

void MemoryPool::free(const Allocation& allocation) {
    Block& block = *static_cast<Block*>(allocation.userData);
    if (--block.alive == 0) block.used = 0;
}

int MemoryPool::allocations() const {
    return std::transform_reduce(m_blocks.begin(), m_blocks.end(), 0, std::plus(),
                                 [](const Block& b) { return b.alive; });
}

std::size_t MemoryPool::bytesUsed() const {
    return std::transform_reduce(m_blocks.begin(), m_blocks.end(), std::size_t(0), std::plus(),
                                 [](const Block& b) { return b.used; });
}

std::size_t MemoryPool::bytesOfBlocks() const {
    return std::transform_reduce(m_blocks.begin(), m_blocks.end(), std::size_t(0), std::plus(),
                                 [](const Block& b) { return b.size; });
}
