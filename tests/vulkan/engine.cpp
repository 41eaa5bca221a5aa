#include "vulkan/engine.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <stdexcept>

namespace probegi::test {

namespace {

void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + ": " + std::to_string(result));
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    ++static_cast<Engine*>(user)->messages;
    std::fprintf(stderr, "Vulkan validation: %s\n", data->pMessage);
    return VK_FALSE;
}

std::uint32_t computeFamily(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i)
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
    throw std::runtime_error("no queue family with compute");
}

std::uint32_t hostMemoryType(VkPhysicalDevice physical, std::uint32_t allowed) {
    const VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(physical, &properties);
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    throw std::runtime_error("no memory that the host sees");
}

}  // namespace

Engine::Engine(const EngineDesc& desc) : m_desc(desc) {
    makeInstance();
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(instance, &count, &physical);
    if (!physical) throw std::runtime_error("no Vulkan device");
    family = computeFamily(physical);
    makeDevice();
    vkGetDeviceQueue(device, family, 0, &queue);
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, family};
    check(vkCreateCommandPool(device, &pool, nullptr, &m_pool), "vkCreateCommandPool");
}

Engine::~Engine() {
    wait();
    for (const EngineBuffer& b : m_buffers) {
        vkDestroyBuffer(device, b.buffer, nullptr);
        vkFreeMemory(device, b.memory, nullptr);
    }
    vkDestroyCommandPool(device, m_pool, nullptr);
    vkDestroyDevice(device, nullptr);
    if (m_messenger) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance, m_messenger, nullptr);
    }
    vkDestroyInstance(instance, nullptr);
    EXPECT_EQ(messages, 0) << "messages of the validation layer: see above";
}

void Engine::makeInstance() {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = m_desc.apiVersion;
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT checks{};
    checks.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    checks.enabledValidationFeatureCount = 1;
    checks.pEnabledValidationFeatures = &enabled;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (m_desc.debugUtils) {
        m_instanceExtensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
        info.pNext = &checks;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
    }
    info.enabledExtensionCount = std::uint32_t(m_instanceExtensions.size());
    info.ppEnabledExtensionNames = m_instanceExtensions.data();
    check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
    if (!m_desc.debugUtils) return;
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = onMessage;
    messenger.pUserData = this;
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
    check(create(instance, &messenger, nullptr, &m_messenger), "vkCreateDebugUtilsMessengerEXT");
}

void* Engine::describeFeatures() {
    m_features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    m_features.features.shaderStorageImageExtendedFormats = m_desc.storageImageExtendedFormats;
    m_features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    m_features12.bufferDeviceAddress = m_desc.bufferDeviceAddress;
    m_features12.scalarBlockLayout = m_desc.scalarBlockLayout;
    m_features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    m_features13.synchronization2 = m_desc.synchronization2;
    m_structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    m_structures.accelerationStructure = VK_TRUE;
    m_rayQuery.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
    m_rayQuery.rayQuery = VK_TRUE;
    m_features.pNext = &m_features12;
    if (m_desc.apiVersion >= VK_API_VERSION_1_3) m_features12.pNext = &m_features13;
    if (m_desc.rayQuery) {
        m_features13.pNext = &m_structures;
        m_structures.pNext = &m_rayQuery;
    }
    return &m_features;
}

void Engine::makeDevice() {
    if (m_desc.rayQuery)
        m_deviceExtensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                              VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
    m_queueInfo = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &m_priority};
    m_createInfo.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    m_createInfo.pNext = describeFeatures();
    m_createInfo.queueCreateInfoCount = 1;
    m_createInfo.pQueueCreateInfos = &m_queueInfo;
    m_createInfo.enabledExtensionCount = std::uint32_t(m_deviceExtensions.size());
    m_createInfo.ppEnabledExtensionNames = m_deviceExtensions.data();
    check(vkCreateDevice(physical, &m_createInfo, nullptr, &device), "vkCreateDevice");
}

vulkan::AdoptDesc Engine::adoptDesc() const {
    vulkan::AdoptDesc desc;
    desc.instance = instance;
    desc.physicalDevice = physical;
    desc.device = device;
    desc.queueFamily = family;
    desc.createInfo = &m_createInfo;
    desc.instanceExtensions = m_instanceExtensions;
    return desc;
}

void Engine::submit(const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, m_pool,
                                         VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    VkCommandBuffer commands;
    check(vkAllocateCommandBuffers(device, &allocate, &commands), "vkAllocateCommandBuffers");
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                         VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    record(commands);
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    check(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
}

void Engine::wait() {
    vkDeviceWaitIdle(device);
}

EngineBuffer Engine::makeBuffer(VkDeviceSize bytes) {
    EngineBuffer made;
    made.bytes = bytes;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                 VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    check(vkCreateBuffer(device, &info, nullptr, &made.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, made.buffer, &needs);
    const VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, nullptr,
                                          VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, 0};
    const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, needs.size,
                                        hostMemoryType(physical, needs.memoryTypeBits)};
    check(vkAllocateMemory(device, &allocate, nullptr, &made.memory), "vkAllocateMemory");
    check(vkBindBufferMemory(device, made.buffer, made.memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
    const VkBufferDeviceAddressInfo address{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, made.buffer};
    made.address = vkGetBufferDeviceAddress(device, &address);
    m_buffers.push_back(made);
    return made;
}

}  // namespace probegi::test
