#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "field_run.h"
#include "probegi/masks.h"
#include "probegi/sdf.h"

namespace probegi::tool {

/// The contents of --stats. A method without a field has no probes and no updates.
struct RenderStats {
    int probes = 0;
    int active = 0;  ///< probes that an update without a budget has among its tasks
    int raysPerProbe = 0;
    FieldRun run;
    double pictureMs = 0;
    std::optional<MaskReport> masks;  ///< only with --leak-guard masks
    std::optional<double> glossyMs;   ///< of that; only with --glossy
    std::optional<double> contactMs;  ///< the same with --contact on
    std::optional<SdfScene> sdf;      ///< of --sdf
};

/// JSON with the keys probes, activeProbes, raysPerProbe, frames, updatedProbes (mean per update of --frames, else 0),
/// converged (null with --frames and without a field),
/// remaining (the estimate behind it, null if there is none), updateMs {trace, shade, blend, total} (medians per
/// update, 0 without updates), pictureMs, with --leak-guard masks the members of MaskReport as
/// masks {...}, with --glossy glossyMs, with --contact on contactMs, with --sdf primitives and primitiveBytes,
/// peakMemoryBytes.
std::string statsJson(const RenderStats& stats);

/// The members of a bake's report; seconds {...} only of masks that this run has baked.
nlohmann::ordered_json masksJson(const MaskReport& report);

/// 0 if there are no values.
double median(std::vector<double> values);

/// Medians of each stage.
UpdateTimes medianTimes(const std::vector<UpdateTimes>& updates);

}  // namespace probegi::tool
