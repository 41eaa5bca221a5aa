#pragma once

#include <optional>
#include <span>

#include "probegi/vulkan.h"
#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// Formats of the probes' atlases. Both preserve energy with dithered rounding (method.md, "Encoding").
inline constexpr vk::Format kIrradianceFormat = vk::Format::eR16G16B16A16Sfloat;
inline constexpr vk::Format kVisibilityFormat = vk::Format::eR16G16Unorm;

/// DeviceInfo::type of a device that runs on the processor.
inline constexpr const char* kSoftwareDevice = "software";

/// Features that a device has, or that were enabled on it.
struct Features {
    bool synchronization2 = false;
    bool bufferDeviceAddress = false;
    bool scalarBlockLayout = false;
    bool storageImageExtendedFormats = false;
    bool accelerationStructure = false;
    bool rayQuery = false;

    /// The name of the first missing required feature; empty: none.
    std::string missing() const;
    bool canRayQuery() const { return accelerationStructure && rayQuery; }
};

Features availableFeatures(const vk::raii::PhysicalDevice& device);
/// From an engine's device create info.
Features enabledFeatures(const VkDeviceCreateInfo& info);

/// The first missing requirement that is not a feature: version, formats, a compute queue. Empty: none.
std::string missingBesidesFeatures(const vk::raii::PhysicalDevice& device);

/// The family for the library's own command buffers: compute, with graphics if possible (as an engine would use).
std::optional<std::uint32_t> computeFamily(const vk::raii::PhysicalDevice& device);

DeviceInfo describe(const vk::raii::PhysicalDevice& device, int index);

}  // namespace probegi::vulkan
