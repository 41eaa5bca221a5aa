#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "probegi/vulkan.h"

namespace probegi::test {

/// What an Engine enables.
struct EngineDesc {
    std::uint32_t apiVersion = VK_API_VERSION_1_3;
    bool synchronization2 = true;
    bool bufferDeviceAddress = true;
    bool scalarBlockLayout = true;
    bool storageImageExtendedFormats = true;
    bool rayQuery = false;
    bool debugUtils = true;  ///< required to see validation messages
};

/// A mapped buffer of the engine, with a device address.
struct EngineBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceAddress address = 0;
    void* mapped = nullptr;
    VkDeviceSize bytes = 0;

    template <class T>
    std::span<T> as() const {
        return {static_cast<T*>(mapped), std::size_t(bytes) / sizeof(T)};
    }
    vulkan::BufferRange range() const { return {address, bytes}; }
};

/// A program with its own instance, device and command buffers, under the validation layer with synchronisation
/// validation. If there are messages, the destructor fails the test.
class Engine {
public:
    explicit Engine(const EngineDesc& desc = {});
    ~Engine();
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    vulkan::AdoptDesc adoptDesc() const;

    /// Records and submits without waiting, so that submissions queue up.
    void submit(const std::function<void(VkCommandBuffer)>& record);
    void wait();
    void run(const std::function<void(VkCommandBuffer)>& record) {
        submit(record);
        wait();
    }

    EngineBuffer makeBuffer(VkDeviceSize bytes);
    template <class T>
    EngineBuffer makeBuffer(std::span<const T> values) {
        const EngineBuffer made = makeBuffer(values.size_bytes());
        std::memcpy(made.mapped, values.data(), values.size_bytes());
        return made;
    }

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    std::atomic<int> messages{0};

private:
    void makeInstance();
    void makeDevice();
    void* describeFeatures();

    EngineDesc m_desc;
    VkPhysicalDeviceFeatures2 m_features{};
    VkPhysicalDeviceVulkan12Features m_features12{};
    VkPhysicalDeviceVulkan13Features m_features13{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR m_structures{};
    VkPhysicalDeviceRayQueryFeaturesKHR m_rayQuery{};
    VkDeviceQueueCreateInfo m_queueInfo{};
    VkDeviceCreateInfo m_createInfo{};
    float m_priority = 1.0f;
    std::vector<const char*> m_instanceExtensions, m_deviceExtensions;
    VkDebugUtilsMessengerEXT m_messenger = VK_NULL_HANDLE;
    VkCommandPool m_pool = VK_NULL_HANDLE;
    std::vector<EngineBuffer> m_buffers;
};

}  // namespace probegi::test
