#pragma once

#include <optional>
#include <span>

#include "probegi/vulkan.h"
#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// Formats of the probes' atlases. Both keep energy with dithered rounding (method.md, "Encoding").
inline constexpr vk::Format kIrradianceFormat = vk::Format::eR16G16B16A16Sfloat;
inline constexpr vk::Format kVisibilityFormat = vk::Format::eR16G16Unorm;

/// DeviceInfo::type of a device that runs on the processor.
inline constexpr const char* kSoftwareDevice = "software";

/// What a device has, or what was enabled on it.
struct Features {
    bool synchronization2 = false;
    bool bufferDeviceAddress = false;
    bool scalarBlockLayout = false;
    bool storageImageExtendedFormats = false;
    bool accelerationStructure = false;
    bool rayQuery = false;

    /// Names the first feature that the library cannot do without and that is not there; empty: none.
    std::string missing() const;
    bool canRayQuery() const { return accelerationStructure && rayQuery; }
};

Features availableFeatures(const vk::raii::PhysicalDevice& device);
/// From what an engine made its device with.
Features enabledFeatures(const VkDeviceCreateInfo& info);

/// Everything else that a device needs: version, formats, a compute queue. Empty: all there.
std::string missingBesidesFeatures(const vk::raii::PhysicalDevice& device);

/// The family for command buffers of the library's own: compute, with graphics where possible (the busiest hardware
/// queue, and what an engine would use).
std::optional<std::uint32_t> computeFamily(const vk::raii::PhysicalDevice& device);

DeviceInfo describe(const vk::raii::PhysicalDevice& device, int index);

}  // namespace probegi::vulkan
