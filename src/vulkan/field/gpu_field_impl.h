#pragma once

#include <optional>

#include "core/sentence.h"
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
        if (!done) {
            passes.forgetRecorded();
            listedRays = {};
        }
        return done;
    }

    PlacesFrame places() {
        const FieldControl::Impl& b = books();
        if (b.states.moving().size() + b.states.media().size() > kMostBounds)
            throw Failure(ErrorCode::invalidArgument, sentence("recorded updates take at most ", kMostBounds,
                                                               " bounds of moving things and media; join some"));
        return {b.states.moving(), b.states.media(), b.chosen, b.taskLists};
    }

    FieldPasses passes;
    /// Of recordTasks() since the last update: how many rays of each kind the caller may have to trace.
    struct ListedRays {
        std::size_t update = 0, fixed = 0;
    };
    std::optional<ListedRays> listedRays;
    FieldControl control;
};

}  // namespace probegi::vulkan
