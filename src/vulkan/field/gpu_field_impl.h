#pragma once

#include "field/control_impl.h"
#include "vulkan/device/errors.h"
#include "vulkan/field/field_passes.h"

namespace probegi::vulkan {

struct GpuField::Impl {
    Impl(const Device& device, const FieldDesc& desc, const FieldSettings& settings)
        : passes(device, desc), control(makeFieldControl(desc, settings)) {}

    FieldControl::Impl& books() noexcept { return control.impl(); }

    /// guarded() for recording passes. If it fails, callers drop the command buffer, so what was recorded never runs.
    template <class Body>
    Result<void> recorded(const char* doing, const Body& body) {
        auto done = guarded(doing, body);
        if (!done) passes.forgetRecorded();
        return done;
    }

    FieldPasses passes;
    FieldControl control;
};

}  // namespace probegi::vulkan
