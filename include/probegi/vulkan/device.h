#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "probegi/context.h"
#include "probegi/export.h"

/// Vulkan devices, adopted from an engine or opened by the library, and timestamps around passes.
namespace probegi::vulkan {

/// A Vulkan device of this machine.
struct DeviceInfo {
    int index = 0;       ///< for OpenDesc::device
    std::string name{};  ///< as reported by the driver
    std::string driver{};
    std::string type{};  ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
    std::string api{};   ///< Vulkan version, "1.3.230"
    bool rayQuery = false;
    std::string missing{};  ///< what ProbeGI needs and the device lacks; empty: usable
    bool usable() const { return missing.empty(); }
};

/// All devices, in the loader's order. Errors: unsupported (no Vulkan loader on this machine, or no driver).
PROBEGI_API Result<std::vector<DeviceInfo>> listDevices();

/// What an allocation will be used for.
enum class MemoryUse : std::uint8_t {
    device,    ///< by the GPU only
    upload,    ///< written by the CPU, read by copies; must be host visible, coherent and mapped
    readback,  ///< written by copies, read by the CPU; must be host visible, coherent and mapped
};

struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;   ///< bytes
    void* mapped = nullptr;    ///< where `offset` is mapped, for upload and readback
    void* userData = nullptr;  ///< the allocator's own
};

/// An engine's memory allocator. Empty functions: the library calls vkAllocateMemory for each buffer and image, about a
/// dozen for a volume and two dozen for a scene. All memory must be allocated with
/// VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT. Buffers and images may share a VkDeviceMemory, so suballocations must respect
/// bufferImageGranularity. `allocate` reports failure by its result and must not throw. Set both functions or neither.
struct Allocator {
    std::function<VkResult(const VkMemoryRequirements&, MemoryUse, Allocation&)> allocate{};
    std::function<void(const Allocation&)> free{};
};

/// An engine's device and how it was created. The engine keeps ownership of all handles, which must outlive every
/// object of this library.
///
/// Needed: Vulkan 1.3 on instance and device; the features synchronization2, bufferDeviceAddress, scalarBlockLayout
/// and shaderStorageImageExtendedFormats; a queue family with compute; the format R16G16B16A16_SFLOAT and R16G16_UNORM
/// as storage images and as sampled images with linear filter. Used where enabled: VK_KHR_acceleration_structure with
/// VK_KHR_ray_query, VK_EXT_debug_utils.
struct AdoptDesc {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;  ///< of the command buffers that passes are recorded into
    /// Other queue families whose shaders read what the library writes, for instance graphics where fields are updated
    /// on an asynchronous compute queue. Buffers and images are then shared by all these families
    /// (VK_SHARING_MODE_CONCURRENT), so that no ownership is transferred; the engine orders the queues with semaphores
    /// (docs/vulkan.md). Empty, or the same family: they belong to one. Read during the call.
    std::span<const std::uint32_t> readingFamilies{};
    /// The device's create info; extensions and features (pNext chain or pEnabledFeatures) are read during the call.
    /// Required.
    const VkDeviceCreateInfo* createInfo = nullptr;
    std::span<const char* const> instanceExtensions{};        ///< enabled ones
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< null: that of the system's loader
    Allocator allocator{};
    /// Folder for the pipeline cache; empty: none, pipelines are compiled every run. A damaged cache file is ignored; a
    /// folder that cannot be written is reported in the context's log.
    std::filesystem::path cacheFolder{};
};

/// How Device::open creates a device.
struct OpenDesc {
    /// An index or part of a name from listDevices(); empty: the first usable device, discrete GPUs before integrated,
    /// virtual and software ones.
    std::string device{};
    bool rayQuery = true;     ///< enable ray query if available
    bool validation = false;  ///< Khronos validation layer with synchronisation validation; messages go to the log
    std::filesystem::path cacheFolder{};                      ///< as AdoptDesc::cacheFolder
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< null: that of the system's loader
};

/// A device with the library's functions, pipelines and memory for it. Cheap to copy (shared handle). The caller must
/// serialise calls on one Device; Devices are independent of each other.
class PROBEGI_API Device {
public:
    /// Errors: invalidArgument (a handle is missing), unsupported (names the missing version, feature or format),
    /// outOfMemory.
    static Result<Device> adopt(const Context& context, const AdoptDesc& desc);
    /// Errors: unsupported (no loader, no such device, or what the device lacks), outOfMemory.
    static Result<Device> open(const Context& context, const OpenDesc& desc = {});

    const DeviceInfo& info() const noexcept;
    bool rayQuery() const noexcept;  ///< whether TracerKind::rayQuery is available
    /// Validation messages so far (OpenDesc::validation).
    int validationMessages() const noexcept;
    /// Writes the compiled pipelines to the cache folder; done by the destructor of the last handle as well.
    /// Errors: writeFailed.
    Result<void> savePipelines() const;

    struct Impl;
    Impl& impl() const noexcept { return *m_impl; }

private:
    explicit Device(std::shared_ptr<Impl> impl) : m_impl(std::move(impl)) {}
    std::shared_ptr<Impl> m_impl;
};

struct PassTime {
    std::string name{};
    double milliseconds = 0;
};

/// GPU timestamps around passes. Pass one to record functions and read it when the command buffer has finished.
class PROBEGI_API Profiler {
public:
    /// `maxPasses` 1..1024. Errors: outOfMemory. A queue family without timestamps gives an empty list, not an error.
    static Result<Profiler> create(const Device& device, int maxPasses = 64);
    Profiler(Profiler&&) noexcept;
    Profiler& operator=(Profiler&&) noexcept;
    ~Profiler();

    /// Resets the timestamps. Record it before the passes of each frame.
    void recordReset(VkCommandBuffer commands);
    /// Times what is recorded between the two calls; passes may not nest. Passes beyond maxPasses are not timed.
    void recordBegin(VkCommandBuffer commands, const char* name);
    void recordEnd(VkCommandBuffer commands);
    /// Milliseconds of each pass, in order. Unchecked: the command buffer must have finished. Errors: deviceLost.
    Result<std::vector<PassTime>> read() const;

    struct Impl;

private:
    explicit Profiler(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi::vulkan
