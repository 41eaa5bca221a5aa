#include "backend/open_backend.h"

namespace probegi {

Result<std::unique_ptr<Backend>> openBackend(const Context& context, const BackendDesc& desc) {
    if (desc.kind == BackendKind::vulkan) return openVulkanBackend(context, desc);
    return makeCpuBackend(context);
}

}  // namespace probegi
