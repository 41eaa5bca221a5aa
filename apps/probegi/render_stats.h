#pragma once

#include <string>
#include <vector>

#include "probegi/field.h"

namespace probegi::tool {

/// When the tool's pictures count a field as converged: relative change, and a cap beyond which the noise that is left
/// is below that of the reference. Stricter than Field::converge's own default, which is for engines.
inline constexpr float kConvergeTolerance = 0.01f;
inline constexpr int kConvergeMaxUpdates = 128;

/// What --stats writes. A method without a field has no probes and no updates.
struct RenderStats {
    int probes = 0;
    int raysPerProbe = 0;
    std::vector<UpdateTimes> updates;
    double pictureMs = 0;
};

/// JSON with the keys probes, raysPerProbe, frames, updateMs {trace, shade, blend, total} (medians per update, 0
/// without updates), pictureMs, peakMemoryBytes.
std::string statsJson(const RenderStats& stats);

/// Median of a copy; 0 of nothing.
double median(std::vector<double> values);

/// Stage by stage.
UpdateTimes medianTimes(const std::vector<UpdateTimes>& updates);

}  // namespace probegi::tool
