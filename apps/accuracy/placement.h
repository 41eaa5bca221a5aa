#pragma once

#include <string>
#include <vector>

#include "probegi/measure.h"
#include "scene_setup.h"

namespace probegi::accuracy {

/// One scene's automatic grid with and without relocation and states.
struct PlacementRow {
    std::string scene;
    int probes = 0;
    std::string placement;  ///< "lattice", "relocation", "states", "both"
    double inside = 0;      ///< share of the probes that look-ups pass over since they stand in walls
    double active = 0;      ///< share of the probes that are updated
    double time = 0;        ///< of an update, over the lattice's
    double difference = 0;  ///< RMS against the same places without states, over the mean; 0 where there are none
    SurfaceError error;     ///< converged, against the path tracer
};

/// Errors: those of the field and its tracer.
Result<std::vector<PlacementRow>> measurePlacement(const Context& context, const std::string& name,
                                                   const tool::LoadedSetup& setup, LeakGuard guard);

/// The table for docs/accuracy.md, with its heading; empty without rows.
std::string placementTable(const std::vector<PlacementRow>& rows);

}  // namespace probegi::accuracy
