#pragma once

#include <span>
#include <vector>

#include "cpu/blend_pass.h"
#include "field/frame_books.h"

namespace probegi {

/// The passes around a blend with windows (kernels/blend/temporal_filter.h), with what they hand to each other.
class TemporalFilter {
public:
    /// Before the blend: what the fixed rays [probe][ray] tell of each probe's lag, and the windows that follow from
    /// the lag of a probe and its neighbours. Without fixed rays the update's own must do. Gives the steps for
    /// BlendFrame.
    std::span<ProbeStep> chooseWindows(const Context& context, const UpdateFrame& frame, const FieldLayout& layout,
                                       std::span<const RayDatum> rayData, std::span<const FixedRayDatum> fixedRays,
                                       FieldStorage& storage);

    /// After the blend: noise from the steps' changes; the fixed rays join their averages.
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

/// After an update that was part of an average over `frames` updates: the windows that such an average has.
void forgetFilters(FieldStorage& storage, float window);

}  // namespace probegi
