#pragma once

// Vulkan-Hpp as this layer uses it: functions are loaded per device, nothing links the loader, and the default
// dispatcher is never used (it is not defined anywhere, so that using it fails to link).
#define VK_NO_PROTOTYPES
#define VULKAN_HPP_DISPATCH_LOADER_DYNAMIC 1
#define VULKAN_HPP_ENABLE_DYNAMIC_LOADER_TOOL 0
#include <vulkan/vulkan_raii.hpp>
