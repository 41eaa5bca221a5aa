#pragma once

#include <probegi/vulkan.h>

#include <vulkan/vulkan_raii.hpp>

/// A descriptor set with which the engine's compute shaders read a probe volume through probegi/query.glsl.
class ProbeSet {
public:
    explicit ProbeSet(const vk::raii::Device& device);

    /// Selects the volume. Do not call it while a command buffer that uses the set is in flight.
    void write(const probegi::vulkan::GpuField& volume) { volume.writeQueryBindings(*m_set, 0); }
    vk::DescriptorSetLayout layout() const { return *m_layout; }
    vk::DescriptorSet operator*() const { return *m_set; }

private:
    vk::raii::DescriptorPool m_pool;
    vk::raii::DescriptorSetLayout m_layout;
    vk::raii::DescriptorSet m_set;
};
