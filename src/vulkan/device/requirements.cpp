#include "vulkan/device/requirements.h"

#include <algorithm>
#include <string_view>

#include "core/sentence.h"

namespace probegi::vulkan {

namespace {

std::string versionText(std::uint32_t version) {
    return sentence(VK_API_VERSION_MAJOR(version), ".", VK_API_VERSION_MINOR(version), ".",
                    VK_API_VERSION_PATCH(version));
}

std::string typeText(vk::PhysicalDeviceType type) {
    switch (type) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return "discrete GPU";
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return "integrated GPU";
        case vk::PhysicalDeviceType::eVirtualGpu:
            return "virtual GPU";
        case vk::PhysicalDeviceType::eCpu:
            return kSoftwareDevice;
        default:
            return "other";
    }
}

bool hasExtension(const std::vector<vk::ExtensionProperties>& extensions, std::string_view name) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const auto& e) { return name == e.extensionName.data(); });
}

// Includes the dependencies of VK_KHR_acceleration_structure.
bool hasRayQueryExtensions(const std::vector<vk::ExtensionProperties>& extensions) {
    return hasExtension(extensions, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME) &&
           hasExtension(extensions, VK_KHR_RAY_QUERY_EXTENSION_NAME) &&
           hasExtension(extensions, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME);
}

bool enables(const VkDeviceCreateInfo& info, std::string_view extension) {
    for (std::uint32_t i = 0; i < info.enabledExtensionCount; ++i)
        if (extension == info.ppEnabledExtensionNames[i]) return true;
    return false;
}

template <class Struct>
const Struct& as(const VkBaseInStructure* link) {
    return *reinterpret_cast<const Struct*>(link);
}

// One link of a pNext chain.
void readFeatures(const VkBaseInStructure* link, Features& f) {
    switch (link->sType) {
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2:
            f.storageImageExtendedFormats |=
                as<VkPhysicalDeviceFeatures2>(link).features.shaderStorageImageExtendedFormats == VK_TRUE;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES:
            f.bufferDeviceAddress |= as<VkPhysicalDeviceVulkan12Features>(link).bufferDeviceAddress == VK_TRUE;
            f.scalarBlockLayout |= as<VkPhysicalDeviceVulkan12Features>(link).scalarBlockLayout == VK_TRUE;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES:
            f.synchronization2 |= as<VkPhysicalDeviceVulkan13Features>(link).synchronization2 == VK_TRUE;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES:
            f.bufferDeviceAddress |=
                as<VkPhysicalDeviceBufferDeviceAddressFeatures>(link).bufferDeviceAddress == VK_TRUE;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES:
            f.scalarBlockLayout |= as<VkPhysicalDeviceScalarBlockLayoutFeatures>(link).scalarBlockLayout == VK_TRUE;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
            f.synchronization2 |= as<VkPhysicalDeviceSynchronization2Features>(link).synchronization2 == VK_TRUE;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR:
            f.accelerationStructure |=
                as<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(link).accelerationStructure == VK_TRUE;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR:
            f.rayQuery |= as<VkPhysicalDeviceRayQueryFeaturesKHR>(link).rayQuery == VK_TRUE;
            break;
        default:
            break;
    }
}

bool formatWorks(const vk::raii::PhysicalDevice& device, vk::Format format) {
    const auto wanted = vk::FormatFeatureFlagBits::eStorageImage | vk::FormatFeatureFlagBits::eSampledImage |
                        vk::FormatFeatureFlagBits::eSampledImageFilterLinear;
    return (device.getFormatProperties(format).optimalTilingFeatures & wanted) == wanted;
}

}  // namespace

std::string Features::missing() const {
    if (!synchronization2) return "the feature synchronization2";
    if (!bufferDeviceAddress) return "the feature bufferDeviceAddress";
    if (!scalarBlockLayout) return "the feature scalarBlockLayout";
    if (!storageImageExtendedFormats) return "the feature shaderStorageImageExtendedFormats";
    return {};
}

Features availableFeatures(const vk::raii::PhysicalDevice& device) {
    Features f;
    // Structures of a newer version must not be chained for an older device.
    if (device.getProperties().apiVersion < VK_API_VERSION_1_3) return f;
    const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                           vk::PhysicalDeviceVulkan13Features>();
    f.storageImageExtendedFormats =
        chain.get<vk::PhysicalDeviceFeatures2>().features.shaderStorageImageExtendedFormats == VK_TRUE;
    f.bufferDeviceAddress = chain.get<vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress == VK_TRUE;
    f.scalarBlockLayout = chain.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout == VK_TRUE;
    f.synchronization2 = chain.get<vk::PhysicalDeviceVulkan13Features>().synchronization2 == VK_TRUE;
    if (hasRayQueryExtensions(device.enumerateDeviceExtensionProperties())) {
        const auto rays =
            device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                                vk::PhysicalDeviceRayQueryFeaturesKHR>();
        f.accelerationStructure =
            rays.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure == VK_TRUE;
        f.rayQuery = rays.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery == VK_TRUE;
    }
    return f;
}

Features enabledFeatures(const VkDeviceCreateInfo& info) {
    Features f;
    if (info.pEnabledFeatures)
        f.storageImageExtendedFormats = info.pEnabledFeatures->shaderStorageImageExtendedFormats == VK_TRUE;
    for (auto* link = static_cast<const VkBaseInStructure*>(info.pNext); link; link = link->pNext)
        readFeatures(link, f);
    f.accelerationStructure &= enables(info, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME);
    f.rayQuery &= enables(info, VK_KHR_RAY_QUERY_EXTENSION_NAME);
    return f;
}

std::string missingBesidesFeatures(const vk::raii::PhysicalDevice& device) {
    const std::uint32_t version = device.getProperties().apiVersion;
    if (version < VK_API_VERSION_1_3) return sentence("Vulkan 1.3 (it has ", versionText(version), ")");
    if (!computeFamily(device)) return "a queue family with compute";
    for (const vk::Format format : {kIrradianceFormat, kVisibilityFormat})
        if (!formatWorks(device, format))
            return sentence("the format ", vk::to_string(format), " as storage image and linearly filtered image");
    return {};
}

std::optional<std::uint32_t> computeFamily(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    std::optional<std::uint32_t> found;
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        if (!(families[i].queueFlags & vk::QueueFlagBits::eCompute)) continue;
        if (families[i].queueFlags & vk::QueueFlagBits::eGraphics) return i;
        if (!found) found = i;
    }
    return found;
}

DeviceInfo describe(const vk::raii::PhysicalDevice& device, int index) {
    const auto properties = device.getProperties();
    DeviceInfo info{
        index, properties.deviceName.data(),  {}, typeText(properties.deviceType), versionText(properties.apiVersion),
        false, missingBesidesFeatures(device)};
    if (properties.apiVersion >= VK_API_VERSION_1_2) {
        const auto driver = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                                .get<vk::PhysicalDeviceDriverProperties>();
        info.driver = sentence(driver.driverName.data(), " ", driver.driverInfo.data());
    }
    const Features features = availableFeatures(device);
    info.rayQuery = features.canRayQuery();
    if (info.missing.empty()) info.missing = features.missing();
    return info;
}

}  // namespace probegi::vulkan
