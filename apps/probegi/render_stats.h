#pragma once

#include <string>
#include <vector>

#include "field_run.h"

namespace probegi::tool {

/// What --stats writes. A method without a field has no probes and no updates.
struct RenderStats {
    int probes = 0;
    int raysPerProbe = 0;
    FieldRun run;
    double pictureMs = 0;
};

/// JSON with the keys probes, raysPerProbe, frames, converged (null with --frames and without a field), remaining (the
/// estimate behind it, null where there is none), updateMs {trace, shade, blend, total} (medians per update, 0 without
/// updates), pictureMs, peakMemoryBytes.
std::string statsJson(const RenderStats& stats);

/// Median of a copy; 0 of nothing.
double median(std::vector<double> values);

/// Stage by stage.
UpdateTimes medianTimes(const std::vector<UpdateTimes>& updates);

}  // namespace probegi::tool
