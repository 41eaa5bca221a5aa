#pragma once

#include <string>
#include <vector>

#include "probegi/reference.h"
#include "scene_setup.h"

namespace probegi::accuracy {

/// Places where light is seen: random points of all surfaces by area, on the side that lies in the open, each looked at
/// from a random direction (cosine-distributed), and what the path tracer finds there.
struct SurfacePoints {
    std::vector<FieldQuery> queries;
    std::vector<double> truth;          ///< luminance of E, W m^-2
    std::vector<double> standardError;  ///< of truth, same unit
};

/// How the field answers there. Places with less than a hundredth of the mean light (the outside of a hull, the inside
/// of a crown of leaves) are left out. The first two weigh every point by its light, so that dark corners, whose ratios
/// mean little, do not decide.
struct SurfaceError {
    double mean = 0;    ///< sum of the field's E over sum of the truth's
    double rms = 0;     ///< root of the mean squared difference over the mean truth; the truth's noise is taken out
    double low = 0;     ///< 5th percentile of the ratios at points with more than a tenth of the mean light
    double median = 0;  ///< 50th percentile
    double high = 0;    ///< 95th percentile
    std::size_t points = 0;  ///< compared
};

/// One line of the table.
struct SurfaceRow {
    std::string scene;
    int probes = 0;
    std::string run;  ///< "converge", or how many updates
    SurfaceError error;
};

/// `count` points of the scene, the same for the same scene; fewer where most of it lies inside matter.
Result<std::vector<FieldQuery>> surfaceQueries(const Scene& scene, const ScenePose& pose, const Tracer& tracer,
                                               int count);

/// The truth at those points, `samples` paths a point. Errors: those of PathTracer.
Result<SurfacePoints> traceSurfacePoints(const Context& context, const tool::LoadedSetup& setup, const Tracer& tracer,
                                         int count, int samples);

/// Errors: those of Field::irradiance.
Result<SurfaceError> compareAtSurfaces(const Field& field, const SurfacePoints& points);
SurfaceError compareAtSurfaces(const std::vector<double>& fieldLuminance, const SurfacePoints& points);

/// The rows of one scene on its automatic grid: converge(), and 300 updates where `updatesToo`.
/// Errors: those of the passes.
Result<std::vector<SurfaceRow>> measureSurface(const Context& context, const std::string& name,
                                               const tool::LoadedSetup& setup, bool updatesToo);

/// The table for docs/accuracy.md, with its heading; empty without rows.
std::string surfaceTable(const std::vector<SurfaceRow>& rows);

}  // namespace probegi::accuracy
