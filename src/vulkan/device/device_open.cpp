#include <algorithm>
#include <charconv>
#include <cstring>

#include "core/sentence.h"
#include "vulkan/device/device_impl.h"
#include "vulkan/device/errors.h"
#include "vulkan/device/loader.h"

namespace probegi::vulkan {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoLoader =
    "there is no Vulkan loader on this machine; install libvulkan1 and a driver, or use the CPU backend";

// The loader also reports out of memory if it cannot parse a driver's manifest.
template <class Body>
auto asking(const Body& body) try {
    return body();
} catch (const vk::OutOfHostMemoryError&) {
    throw Failure(
        ErrorCode::unsupported,
        "Vulkan cannot start: a driver's .json file is damaged (they are in /usr/share/vulkan/icd.d, or where "
        "VK_DRIVER_FILES and VK_ICD_FILENAMES say), or memory has run out; repair the file, or use the CPU "
        "backend");
}

bool hasLayer(const vk::raii::Context& vulkan, const char* name) {
    for (const auto& layer : asking([&] { return vulkan.enumerateInstanceLayerProperties(); }))
        if (std::strcmp(layer.layerName.data(), name) == 0) return true;
    return false;
}

bool hasInstanceExtension(const vk::raii::Context& vulkan, const char* name) {
    for (const auto& extension : asking([&] { return vulkan.enumerateInstanceExtensionProperties(); }))
        if (std::strcmp(extension.extensionName.data(), name) == 0) return true;
    return false;
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    const auto& impl = *static_cast<const Device::Impl*>(user);
    ++impl.validationMessages;
    impl.warn(sentence("Vulkan validation: ", data->pMessage));
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(const Device::Impl& impl) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    return {{},
            Severity::eError | Severity::eWarning,
            Type::eValidation | Type::ePerformance,
            onMessage,
            const_cast<Device::Impl*>(&impl)};
}

vk::raii::Instance makeInstance(const vk::raii::Context& vulkan, bool validation, bool debugUtils) {
    const vk::ApplicationInfo application("ProbeGI", 1, "ProbeGI", 1, VK_API_VERSION_1_3);
    std::vector<const char*> layers, extensions;
    if (debugUtils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    const vk::ValidationFeatureEnableEXT enables[] = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT checks(enables);
    if (validation) {
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    const vk::InstanceCreateInfo info({}, &application, layers, extensions, validation ? &checks : nullptr);
    return asking([&] { return vk::raii::Instance(vulkan, info); });
}

// Preference order, best first.
int rank(const vk::raii::PhysicalDevice& device) {
    switch (device.getProperties().deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return 0;
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return 1;
        case vk::PhysicalDeviceType::eVirtualGpu:
            return 2;
        default:
            return 3;
    }
}

std::string listed(const std::vector<DeviceInfo>& infos) {
    std::string text;
    for (const DeviceInfo& info : infos) text += sentence(text.empty() ? "" : ", ", info.index, " '", info.name, "'");
    return text;
}

// The device named by `wanted`: an index, or part of a name, case-insensitive.
std::size_t findNamed(const std::vector<DeviceInfo>& infos, const std::string& wanted) {
    std::size_t index = 0;
    const auto parsed = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (parsed.ec == std::errc() && parsed.ptr == wanted.data() + wanted.size() && index < infos.size()) return index;
    const auto lower = [](std::string text) {
        for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
        return text;
    };
    // A number that is not an index may be part of a name: "3090".
    for (const DeviceInfo& info : infos)
        if (lower(info.name).find(lower(wanted)) != std::string::npos) return std::size_t(info.index);
    throw Failure(ErrorCode::unsupported,
                  sentence("there is no Vulkan device '", wanted, "'; there are: ", listed(infos)));
}

std::size_t choose(const std::vector<vk::raii::PhysicalDevice>& devices, const std::string& wanted) {
    if (devices.empty())
        throw Failure(ErrorCode::unsupported,
                      "no Vulkan driver found a device; install a driver (mesa-vulkan-drivers has a software one), or "
                      "use the CPU backend");
    std::vector<DeviceInfo> infos;
    for (std::size_t i = 0; i < devices.size(); ++i) infos.push_back(describe(devices[i], int(i)));
    if (!wanted.empty()) {
        const std::size_t index = findNamed(infos, wanted);
        if (infos[index].usable()) return index;
        throw Failure(ErrorCode::unsupported,
                      sentence("the Vulkan device '", infos[index].name, "' lacks ", infos[index].missing,
                               "; choose another one or use the CPU backend"));
    }
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (infos[i].usable() && (!best || rank(devices[i]) < rank(devices[*best]))) best = i;
    if (best) return *best;
    throw Failure(ErrorCode::unsupported, sentence("no Vulkan device is usable: '", infos[0].name, "' lacks ",
                                                   infos[0].missing, "; use the CPU backend"));
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical, std::uint32_t family, bool rayQuery) {
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
    std::vector<const char*> extensions;
    if (rayQuery)
        extensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                      VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                       vk::PhysicalDeviceVulkan13Features, vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                       vk::PhysicalDeviceRayQueryFeaturesKHR>
        chain;
    chain.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue).setPEnabledExtensionNames(extensions);
    chain.get<vk::PhysicalDeviceFeatures2>().features.setShaderStorageImageExtendedFormats(true);
    chain.get<vk::PhysicalDeviceVulkan12Features>().setBufferDeviceAddress(true).setScalarBlockLayout(true);
    chain.get<vk::PhysicalDeviceVulkan13Features>().setSynchronization2(true);
    chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().setAccelerationStructure(true);
    chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().setRayQuery(true);
    if (!rayQuery) {
        chain.unlink<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
        chain.unlink<vk::PhysicalDeviceRayQueryFeaturesKHR>();
    }
    return {physical, chain.get<vk::DeviceCreateInfo>()};
}

}  // namespace

Result<std::vector<DeviceInfo>> listDevices() {
    const PFN_vkGetInstanceProcAddr loader = systemLoader();
    if (!loader || !loader(nullptr, "vkCreateInstance")) return fail(ErrorCode::unsupported, kNoLoader);
    return guarded("listing devices", [&] {
        const vk::raii::Context vulkan(loader);
        const vk::raii::Instance instance = makeInstance(vulkan, false, false);
        std::vector<DeviceInfo> infos;
        for (const auto& device : instance.enumeratePhysicalDevices())
            infos.push_back(describe(device, int(infos.size())));
        return infos;
    });
}

Result<Device> Device::open(const Context& context, const OpenDesc& desc) {
    const PFN_vkGetInstanceProcAddr loader = desc.getInstanceProcAddr ? desc.getInstanceProcAddr : systemLoader();
    if (!loader || !loader(nullptr, "vkCreateInstance")) return fail(ErrorCode::unsupported, kNoLoader);
    return guarded("opening a device", [&] {
        auto impl = std::make_shared<Impl>(context, loader);
        impl->owned = true;
        if (desc.validation && !hasLayer(impl->vulkan, kValidationLayer))
            throw Failure(ErrorCode::unsupported,
                          "the Khronos validation layer is not installed (vulkan-validationlayers)");
        const bool debugUtils =
            desc.validation || hasInstanceExtension(impl->vulkan, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        impl->instance = makeInstance(impl->vulkan, desc.validation, debugUtils);
        impl->debugUtilsEnabled = debugUtils;
        if (desc.validation) impl->messenger.emplace(impl->instance, messengerInfo(*impl));
        std::vector<vk::raii::PhysicalDevice> devices;
        for (auto& device : impl->instance.enumeratePhysicalDevices()) devices.push_back(std::move(device));
        const std::size_t chosen = choose(devices, desc.device);
        impl->info = describe(devices[chosen], int(chosen));
        impl->physical = std::move(devices[chosen]);
        impl->family = *computeFamily(impl->physical);
        Features features = availableFeatures(impl->physical);
        features.rayQuery &= desc.rayQuery;
        impl->device = makeDevice(impl->physical, impl->family, features.canRayQuery());
        impl->queue = impl->device.getQueue(impl->family, 0);
        impl->submitter.emplace(impl->device, impl->queue, impl->family);
        impl->finish(features, desc.cacheFolder);
        return Device(std::move(impl));
    });
}

}  // namespace probegi::vulkan
