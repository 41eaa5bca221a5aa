#include "backend/open_backend.h"
#include "probegi/vulkan/standalone.h"

namespace probegi {

Result<std::unique_ptr<Backend>> openVulkanBackend(const Context& context, const BackendDesc& desc) {
    vulkan::OpenDesc open;
    open.device = desc.device;
    open.cacheFolder = desc.cacheFolder;
    const auto device = vulkan::Device::open(context, open);
    if (!device) return device.error();
    return vulkan::makeBackend(context, *device, desc.tracer);
}

}  // namespace probegi
