#pragma once

#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// vkGetInstanceProcAddr of the system's Vulkan loader; null if none is installed. The loader stays loaded for the
/// lifetime of the process.
PFN_vkGetInstanceProcAddr systemLoader() noexcept;

}  // namespace probegi::vulkan
