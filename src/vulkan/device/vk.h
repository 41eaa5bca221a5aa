#pragma once

// Vulkan-Hpp as this layer uses it: functions are loaded per device, nothing links the loader, and the default
// dispatcher is never used (it is not defined anywhere, so using it fails to link). It has a namespace of its own
// because an engine that links this library may use another version of Vulkan-Hpp, or other settings, which would
// violate the one definition rule.
#define VK_NO_PROTOTYPES
#define VULKAN_HPP_DISPATCH_LOADER_DYNAMIC 1
#define VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL 0
#define VULKAN_HPP_NAMESPACE probegi_vk
#include <vulkan/vulkan_raii.hpp>

namespace probegi::vulkan {
namespace vk = ::probegi_vk;
}
