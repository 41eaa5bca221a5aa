#include "backend/open_backend.h"

namespace probegi {

Result<std::unique_ptr<Backend>> openVulkanBackend(const Context&, const BackendDesc&) {
    return fail(ErrorCode::unsupported,
                "this ProbeGI was built without its Vulkan backend (PROBEGI_VULKAN is OFF); use BackendKind::cpu");
}

}  // namespace probegi
