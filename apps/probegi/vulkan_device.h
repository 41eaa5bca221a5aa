#pragma once

#include "backend.h"
#if PROBEGI_HAS_VULKAN
#include "probegi/vulkan.h"
#endif

namespace probegi::tool {

/// The error of a program built without Vulkan.
Error builtWithoutVulkan();

#if PROBEGI_HAS_VULKAN
/// Opens the requested device. Errors: unsupported, also for --tracer ray-query on a device without ray query.
Result<vulkan::Device> openDevice(const Context& context, const BackendOptions& options);
#endif

}  // namespace probegi::tool
