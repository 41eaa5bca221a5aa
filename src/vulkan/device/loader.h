#pragma once

#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// vkGetInstanceProcAddr of the system's Vulkan loader; null where none is installed. The loader stays loaded for the
/// life of the process.
PFN_vkGetInstanceProcAddr systemLoader() noexcept;

}  // namespace probegi::vulkan
