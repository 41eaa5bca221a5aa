#pragma once

#include "backend.h"
#if PROBEGI_HAS_VULKAN
#include "probegi/vulkan.h"
#endif

namespace probegi::tool {

/// What a program says that was built without Vulkan.
Error builtWithoutVulkan();

#if PROBEGI_HAS_VULKAN
/// The device that was asked for. Errors: unsupported, and --tracer ray-query on a device without it.
Result<vulkan::Device> openDevice(const Context& context, const BackendOptions& options);
#endif

}  // namespace probegi::tool
