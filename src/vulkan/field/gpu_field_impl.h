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
        if (!b.schedule.limited()) return {b.states.moving(), b.states.media(), b.chosen, b.taskLists};
        picked.clear();
        for (const ProbeTask& task : b.tasks) picked.push_back(task.slot);
        return {b.states.moving(), b.states.media(), picked, b.taskLists};
    }

    /// After an update was recorded. The GPU tells late: of updates that it has finished by now.
    void advance() {
        books().advance();
        if (!books().schedule.limited()) return;
        books().schedule.hear(passes.progress());
        books().chooseTasks();
    }

    FieldPasses passes;
    /// Of recordTasks() since the last update: how many rays of each kind the caller may have to trace.
    struct ListedRays {
        std::size_t update = 0, fixed = 0;
    };
    std::optional<ListedRays> listedRays;
    std::vector<std::uint32_t> picked;  // slots of the tasks that a budget pays for
    FieldControl control;
};

}  // namespace probegi::vulkan
