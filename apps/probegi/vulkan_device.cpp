#include "vulkan_device.h"

#include <fmt/format.h>

namespace probegi::tool {

Error builtWithoutVulkan() {
    return {ErrorCode::unsupported,
            "this probegi was built without its Vulkan backend (PROBEGI_VULKAN is OFF); use --backend cpu"};
}

#if PROBEGI_HAS_VULKAN

Result<vulkan::Device> openDevice(const Context& context, const BackendOptions& options) {
    vulkan::OpenDesc desc;
    desc.device = options.device;
    desc.cacheFolder = shaderCacheFolder(options);
    auto device = vulkan::Device::open(context, desc);
    if (device && options.tracer == TracerKind::rayQuery && !device->rayQuery())
        return fail(ErrorCode::unsupported,
                    fmt::format("the Vulkan device '{}' has no ray query; use --tracer bvh, or another --device",
                                device->info().name));
    return device;
}

#endif

}  // namespace probegi::tool
