#pragma once

#include "backend.h"
#if PROBEGI_HAS_VULKAN
#include "probegi/vulkan.h"
#endif

namespace probegi::tool {

/// A program that was built without Vulkan answers with an error that says so.
Result<std::unique_ptr<Backend>> openVulkanBackend(const Context& context, const BackendOptions& options);

/// What such a program says.
Error builtWithoutVulkan();

#if PROBEGI_HAS_VULKAN
/// The device that was asked for. Errors: unsupported, and --tracer ray-query on a device without it.
Result<vulkan::Device> openDevice(const Context& context, const BackendOptions& options);

vulkan::TracerKind tracerKind(GpuTracer tracer) noexcept;
#endif

}  // namespace probegi::tool
