#pragma once

#include <string>
#include <vector>

#include "probegi/measure.h"
#include "scene_setup.h"

namespace probegi::accuracy {

/// One line of the table.
struct SurfaceRow {
    std::string scene;
    int probes = 0;
    std::string run;  ///< "converge", or how many updates
    SurfaceError error;
};

/// What the path tracer finds at random points of the surfaces. Errors: those of the tracers.
Result<SurfaceTruth> surfaceTruth(const Context& context, const tool::LoadedSetup& setup, const Tracer& tracer,
                                  int points, int pathsPerPoint);

/// The rows of one scene on its automatic grid: converge(), and with `updatesToo` 300 updates.
/// Errors: those of the field and its tracer.
Result<std::vector<SurfaceRow>> measureSurface(const Context& context, const std::string& name,
                                               const tool::LoadedSetup& setup, bool updatesToo);

/// The table for docs/accuracy.md, with its heading; empty without rows.
std::string surfaceTable(const std::vector<SurfaceRow>& rows);

}  // namespace probegi::accuracy
