#include "resources.h"

using probegi::vulkan::MemoryUse;

namespace {

constexpr auto kBufferUsage = vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eShaderDeviceAddress |
                              vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;

vk::ImageAspectFlags aspectOf(vk::Format format) {
    return format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::ImageCreateInfo describe(vk::Format format, vk::Extent2D size, vk::ImageUsageFlags usage) {
    return {{},
            vk::ImageType::e2D,
            format,
            {size.width, size.height, 1},
            1,
            1,
            vk::SampleCountFlagBits::e1,
            vk::ImageTiling::eOptimal,
            usage};
}

}  // namespace

PoolMemory::PoolMemory(MemoryPool& pool, const VkMemoryRequirements& needs, MemoryUse use) : m_pool(pool) {
    const VkResult result = pool.allocate(needs, use, m_allocation);
    if (result != VK_SUCCESS) vk::throwResultException(vk::Result(result), "MemoryPool");
}

GpuBuffer::GpuBuffer(const vk::raii::Device& device, MemoryPool& pool, vk::DeviceSize size, MemoryUse use)
    : bytes(size),
      buffer(device, vk::BufferCreateInfo({}, size, kBufferUsage)),
      memory(pool, buffer.getMemoryRequirements(), use) {
    buffer.bindMemory((*memory).memory, (*memory).offset);
    address = device.getBufferAddress({*buffer});
}

GpuImage::GpuImage(const vk::raii::Device& device, MemoryPool& pool, vk::Format f, vk::Extent2D size,
                   vk::ImageUsageFlags usage)
    : format(f),
      aspect(aspectOf(f)),
      image(device, describe(f, size, usage)),
      memory(pool, image.getMemoryRequirements(), MemoryUse::device),
      view(nullptr) {
    image.bindMemory((*memory).memory, (*memory).offset);
    view = device.createImageView({{}, *image, vk::ImageViewType::e2D, f, {}, range()});
}

void order(const vk::raii::CommandBuffer& commands, Access before, Access after) {
    const vk::MemoryBarrier2 barrier(before.stages, before.access, after.stages, after.access);
    commands.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(barrier));
}

vk::ImageMemoryBarrier2 transition(const GpuImage& image, Access before, vk::ImageLayout from, Access after,
                                   vk::ImageLayout to) {
    return {before.stages,           before.access,           after.stages, after.access, from, to,
            VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image.image, image.range()};
}

vk::raii::DescriptorSetLayout makeSetLayout(const vk::raii::Device& device,
                                            std::span<const vk::DescriptorSetLayoutBinding> bindings) {
    return {device, vk::DescriptorSetLayoutCreateInfo({}, std::uint32_t(bindings.size()), bindings.data())};
}

vk::raii::Pipeline makeComputePipeline(const vk::raii::Device& device, vk::PipelineLayout layout,
                                       std::span<const std::uint32_t> code) {
    const vk::raii::ShaderModule module(device, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    return {device, nullptr, vk::ComputePipelineCreateInfo({}, stage, layout)};
}
