#include "engine_device.h"

#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace {

constexpr const char* kValidation = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    ++*static_cast<int*>(messages);
    return VK_FALSE;
}

std::optional<std::uint32_t> graphicsFamily(const vk::raii::PhysicalDevice& device) {
    const auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    const auto families = device.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & wanted) == wanted) return i;
    return std::nullopt;
}

bool hasExtension(const vk::raii::PhysicalDevice& device, std::string_view name) {
    for (const auto& extension : device.enumerateDeviceExtensionProperties())
        if (name == extension.extensionName.data()) return true;
    return false;
}

}  // namespace

EngineDevice::EngineDevice() {
    makeInstance();
    makeDevice();
}

void EngineDevice::makeInstance() {
    bool validation = false;
    for (const auto& layer : m_loader.enumerateInstanceLayerProperties())
        validation |= std::string_view(layer.layerName.data()) == kValidation;
    std::vector<const char*> layers;
    if (validation) {
        layers = {kValidation};
        m_instanceExtensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    }
    const vk::ApplicationInfo application("vulkan_engine", 1, nullptr, 0, VK_API_VERSION_1_3);
    const auto synchronisation = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    const vk::ValidationFeaturesEXT features(synchronisation);
    m_instance = vk::raii::Instance(m_loader, vk::InstanceCreateInfo({}, &application, layers, m_instanceExtensions,
                                                                     validation ? &features : nullptr));
    if (!validation) return;
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    m_messenger = vk::raii::DebugUtilsMessengerEXT(
        m_instance, vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                                         vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation, onMessage,
                                                         &m_messages));
}

void EngineDevice::makeDevice() {
    for (auto& device : m_instance.enumeratePhysicalDevices()) {
        const auto properties = device.getProperties();
        const auto family = graphicsFamily(device);
        if (!family || properties.apiVersion < VK_API_VERSION_1_3) continue;
        const bool first = !*m_physical;
        if (!first && properties.deviceType != vk::PhysicalDeviceType::eDiscreteGpu) continue;
        m_physical = std::move(device);
        m_family = *family;
        if (properties.deviceType == vk::PhysicalDeviceType::eDiscreteGpu) break;
    }
    if (!*m_physical) throw std::runtime_error("no device with Vulkan 1.3 and a queue for graphics and compute");

    m_created.get<vk::PhysicalDeviceFeatures2>().features.setShaderStorageImageExtendedFormats(true);
    m_created.get<vk::PhysicalDeviceVulkan12Features>().setBufferDeviceAddress(true).setScalarBlockLayout(true);
    m_created.get<vk::PhysicalDeviceVulkan13Features>().setSynchronization2(true).setDynamicRendering(true);
    const bool rayQuery = hasExtension(m_physical, VK_KHR_RAY_QUERY_EXTENSION_NAME);
    m_created.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().setAccelerationStructure(rayQuery);
    m_created.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().setRayQuery(rayQuery);
    if (rayQuery) {
        m_deviceExtensions = {VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                              VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
    } else {  // drivers must not be passed structures they do not know
        m_created.unlink<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
        m_created.unlink<vk::PhysicalDeviceRayQueryFeaturesKHR>();
    }
    m_queueCreated = vk::DeviceQueueCreateInfo({}, m_family, 1, &m_priority);
    m_created.get<vk::DeviceCreateInfo>()
        .setQueueCreateInfos(m_queueCreated)
        .setPEnabledExtensionNames(m_deviceExtensions);
    m_device = vk::raii::Device(m_physical, m_created.get<vk::DeviceCreateInfo>());
    m_queue = m_device.getQueue(m_family, 0);
}
