#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "probegi/vulkan.h"
#include "vulkan/device/pipelines.h"
#include "vulkan/device/requirements.h"
#include "vulkan/device/submitter.h"

namespace probegi::vulkan {

/// State shared by all objects of a device.
struct Device::Impl {
    Impl(const Context& c, PFN_vkGetInstanceProcAddr loader)
        : context(c), vulkan(loader), instance(nullptr), physical(nullptr), device(nullptr), queue(nullptr) {}
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// The last step of both open and adopt: limits, pipelines. instance, physical, device and family must be set.
    void finish(const Features& features, const std::filesystem::path& cacheFolder);

    /// For debuggers, if VK_EXT_debug_utils is enabled.
    void setName(vk::ObjectType type, std::uint64_t handle, const char* name) const;
    bool debugUtils() const noexcept { return debugUtilsEnabled; }
    void warn(const std::string& sentence) const { context.log(LogLevel::warning, sentence); }

    Context context;
    vk::raii::Context vulkan;
    vk::raii::Instance instance;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
    vk::raii::PhysicalDevice physical;
    vk::raii::Device device;
    vk::raii::Queue queue;  ///< null on an engine's device
    bool owned = false;     ///< whether instance and device are the library's
    bool debugUtilsEnabled = false;
    bool rayQuery = false;
    std::uint32_t family = 0;
    std::vector<std::uint32_t> sharing;  ///< families that share buffers and images; empty: `family` has them alone
    DeviceInfo info;
    vk::PhysicalDeviceLimits limits;
    vk::PhysicalDeviceMemoryProperties memoryProperties;
    std::uint32_t scratchAlignment = 1;  ///< for acceleration structure builds
    std::uint32_t timestampBits = 0;
    VkDeviceSize maxBufferBytes = 0;
    Allocator allocator;
    mutable std::atomic<int> validationMessages{0};
    mutable std::optional<Submitter> submitter;      // empty on an engine's device
    mutable std::optional<PipelineStore> pipelines;  // compiles on demand
};

}  // namespace probegi::vulkan
