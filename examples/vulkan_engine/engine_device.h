#pragma once

#include <vector>
#include <vulkan/vulkan_raii.hpp>

/// The engine's own Vulkan instance, device and queue, independent of ProbeGI. createInfo() and instanceExtensions()
/// return what it enabled, for Device::adopt().
class EngineDevice {
public:
    EngineDevice();
    EngineDevice(const EngineDevice&) = delete;
    EngineDevice& operator=(const EngineDevice&) = delete;

    const vk::raii::Instance& instance() const { return m_instance; }
    const vk::raii::PhysicalDevice& physical() const { return m_physical; }
    const vk::raii::Device& device() const { return m_device; }
    const vk::raii::Queue& queue() const { return m_queue; }
    std::uint32_t family() const { return m_family; }
    const std::vector<const char*>& instanceExtensions() const { return m_instanceExtensions; }
    const VkDeviceCreateInfo& createInfo() const { return m_created.get<vk::DeviceCreateInfo>(); }
    /// Warnings and errors of the validation layer so far; 0 if the layer is not installed.
    int validationMessages() const { return m_messages; }

private:
    void makeInstance();
    void makeDevice();

    vk::raii::Context m_loader{vkGetInstanceProcAddr};
    std::vector<const char*> m_instanceExtensions, m_deviceExtensions;
    int m_messages = 0;
    vk::raii::Instance m_instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT m_messenger{nullptr};
    vk::raii::PhysicalDevice m_physical{nullptr};
    std::uint32_t m_family = 0;
    float m_priority = 1;
    vk::DeviceQueueCreateInfo m_queueCreated;
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                       vk::PhysicalDeviceVulkan13Features, vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                       vk::PhysicalDeviceRayQueryFeaturesKHR>
        m_created;
    vk::raii::Device m_device{nullptr};
    vk::raii::Queue m_queue{nullptr};
};
