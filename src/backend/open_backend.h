#pragma once

#include "probegi/backend.h"

namespace probegi {

/// The backend of BackendKind::cpu.
std::unique_ptr<Backend> makeCpuBackend(const Context& context);

/// Opens the desc's device. Errors: as openBackend().
Result<std::unique_ptr<Backend>> openVulkanBackend(const Context& context, const BackendDesc& desc);

}  // namespace probegi
