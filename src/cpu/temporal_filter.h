#pragma once

#include <span>
#include <vector>

#include "cpu/probe_blend.h"
#include "field/frame_books.h"

namespace probegi {

/// The passes around a blend with windows (kernels/blend/temporal_filter.h), and their shared data.
class TemporalFilter {
public:
    /// Before the blend: each probe's lag from the fixed rays [probe][ray], and the windows from the lag of a probe and
    /// its neighbours. Without fixed rays the update's own are used. Returns the steps for BlendFrame.
    std::span<ProbeStep> chooseWindows(const Context& context, const UpdateFrame& frame, const FieldLayout& layout,
                                       std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays,
                                       FieldStorage& storage);

    /// After the blend: updates noise from the steps' changes, and the averages of the fixed rays.
    void advance(const Context& context, const UpdateFrame& frame, FieldStorage& storage);

    std::size_t bytes() const noexcept;

private:
    void measureLag(const Context& context, const UpdateFrame& frame, const FieldLayout& layout,
                    std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays,
                    const FieldStorage& storage);

    std::vector<kernels::ProbeSight> m_sights;
    std::vector<kernels::ProbeLag> m_lags;
    std::vector<ProbeStep> m_steps;
};

/// After the updates of an average: sets the windows that such an average has.
void forgetFilters(FieldStorage& storage, float window);

}  // namespace probegi
