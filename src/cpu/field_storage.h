#pragma once

#include <cstdint>
#include <vector>

#include "field/layout.h"
#include "kernels/blend/temporal_filter.h"
#include "kernels/probe/solid_probe.h"

namespace probegi {

/// What the probes remember, in the default formats: 1,464 bytes a probe at 8x8 and 16x16 texels.
struct FieldStorage {
    explicit FieldStorage(const FieldLayout& layout);

    /// Half floats, encoded (mean radiance)^(1/5): [probe][texel][rgb]. One spare value at the end, so that the last
    /// texel can be read as four halves.
    std::vector<std::uint16_t> irradiance;
    /// Mean (low 16 bits) and mean square (high 16 bits) of distance / maxDistance, as unorm: [probe][texel].
    std::vector<std::uint32_t> visibility;
    /// Averages and windows of the temporal filter: [probe].
    std::vector<kernels::PackedProbeFilter> filters;
    /// Share of the hits that were on backs and speak for solid matter, 0..1, averaged over frames: [probe].
    std::vector<float> backfaceShare;
    /// State and offset: [probe]. Set by the field's books (FieldBackend::setPlacements).
    std::vector<std::uint32_t> placements;
    /// What that share is made from: [probe].
    std::vector<kernels::ProbeSides> sides;
};

}  // namespace probegi
