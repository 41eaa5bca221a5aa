#pragma once

#include <string>

#include "bake/baking.h"

namespace probegi::tool {

/// What was baked, and what it took: a few lines.
std::string bakeText(const BakeReport& report, const BakeOptions& options, const LoadedSetup& setup);
/// JSON with the keys probes, raysPerProbe, updates, updatesBefore, converged, remaining, seconds {masks, light, file},
/// fileBytes, fieldBytes, masks {as --stats of render}, peakMemoryBytes.
std::string bakeJson(const BakeReport& report, const BakeOptions& options, const LoadedSetup& setup);

}  // namespace probegi::tool
