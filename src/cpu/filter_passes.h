#pragma once

#include <span>
#include <vector>

#include "cpu/blend_pass.h"
#include "field/update_frame.h"

namespace probegi {

/// The passes around a blend with windows (kernels/blend/temporal_filter.h), and their shared data.
class TemporalFilter {
public:
    /// Before the blend: what the fixed rays [task][ray] tell of each probe's lag, and the windows that follow from
    /// the lag of a probe and its neighbours. Without fixed rays the update's own must do. Gives the steps for
    /// BlendFrame.
    std::span<ProbeStep> chooseWindows(const Context& context, const UpdateFrame& frame,
                                       std::span<const kernels::Volume> volumes, std::span<const RayDatum> rayData,
                                       std::span<const FixedRayDatum> fixedRays, FieldStorage& storage);

    /// Before a blend without windows: the steps for BlendFrame in an update with events in boxes; none in others.
    std::span<ProbeStep> keepLessAtEvents(const UpdateFrame& frame, const FieldStorage& storage);

    /// After the blend: noise from the steps' changes; the fixed rays join their averages. Reports progress() where the
    /// frame asks for it.
    void advance(const Context& context, const UpdateFrame& frame, std::span<const kernels::Volume> volumes,
                 FieldStorage& storage);

    /// [slot], of the tasks of updates whose frames asked for it; else empty.
    std::span<const kernels::ProbeProgress> progress() const noexcept { return m_progress; }
    std::size_t bytes() const noexcept;

private:
    void measureLag(const Context& context, const UpdateFrame& frame, std::span<const kernels::Volume> volumes,
                    std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays,
                    const FieldStorage& storage);

    std::vector<kernels::ProbeSight> m_sights;  // [task]
    std::vector<kernels::ProbeLag> m_lags;      // [slot]; none of probes that are no task
    std::vector<ProbeStep> m_steps;             // [task]
    std::vector<kernels::ProbeProgress> m_progress;
};

/// After an update that was part of an average, or by the paper's rules: the windows that such an update has.
void forgetFilters(std::span<const ProbeTask> tasks, float window, FieldStorage& storage);

}  // namespace probegi
