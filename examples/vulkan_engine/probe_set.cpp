#include "probe_set.h"

using probegi::vulkan::GpuField;

namespace {

vk::raii::DescriptorPool makePool(const vk::raii::Device& device) {
    const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eUniformBuffer, 1},
                                            {vk::DescriptorType::eCombinedImageSampler, 2},
                                            {vk::DescriptorType::eStorageBuffer, 1}};
    return {device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
}

vk::raii::DescriptorSetLayout makeLayout(const vk::raii::Device& device) {
    const auto bindings = GpuField::queryBindings(0, VK_SHADER_STAGE_COMPUTE_BIT);
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0, {}, {}};
    info.bindingCount = std::uint32_t(bindings.size());
    info.pBindings = bindings.data();
    return {device, info};
}

}  // namespace

ProbeSet::ProbeSet(const vk::raii::Device& device)
    : m_pool(makePool(device)),
      m_layout(makeLayout(device)),
      m_set(std::move(vk::raii::DescriptorSets(device, {*m_pool, *m_layout}).front())) {}
