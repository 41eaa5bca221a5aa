#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "backend.h"
#include "field_run.h"
#include "probe_ratio.h"
#include "probegi/compare.h"
#include "scene_setup.h"

namespace probegi::tool {

/// How a report's pictures are made.
struct ReportSettings {
    int width = 960;
    int height = 540;
    bool diffuseOnly = false;
    int raysPerProbe = FieldDesc{}.raysPerProbe;
    FieldRunOptions run;
    std::optional<int> realtimeUpdates;  ///< where given, a fresh field is also filled by so many of Field::update
    double seconds = 45;                 ///< of the reference; 0: no limit
    int samplesPerPixel = 0;             ///< of the reference; 0: no limit
    int ratioProbes = 128;               ///< probes that are compared with the reference
    int ratioSamples = 256;              ///< paths per probe and direction
    std::uint64_t seed = 1;
};

/// One way of lighting the scene, and how far it is from the reference.
struct MethodResult {
    Picture picture;
    double pictureMs = 0;
    Comparison whole;              ///< of the picture
    ImageDifference indirectOnly;  ///< of the indirect light alone
};

/// What a field cost, and how its probes compare with the truth.
struct FieldResult {
    FieldRun run;
    std::string description;  ///< of the run, for tables
    double seconds = 0;       ///< all updates
    UpdateTimes update;       ///< medians, milliseconds
    FieldMemory memory;
    Percentiles ratio;  ///< probe irradiance over truth
};

/// A field and the picture with it.
struct FieldPicture {
    FieldResult field;
    MethodResult method;
};

/// Everything that the report says of one scene.
struct RenderedScene {
    std::size_t triangles = 0;
    std::size_t lights = 0;
    GridDesc grid;
    double prepareSeconds = 0;  ///< tracer and light sampling structures
    MethodResult none, leaky, ddgi;
    FieldResult leakyField, ddgiField;
    std::optional<FieldPicture> realtime;  ///< with ReportSettings::realtimeUpdates
    Picture reference;
    int referenceSamples = 0;
    double referenceSeconds = 0;
    double referenceNoise = 0;   ///< mean standard error over mean value of the picture
    ImageDifference noiseFloor;  ///< what an exact picture would score against this reference, for its noise
    /// The same of the indirect light alone, with all the noise up to the indirect light itself: what is above, at the
    /// edges of lamps, is direct light's.
    ImageDifference indirectNoiseFloor;
    ProbeTruth truth;
};

/// Renders all four pictures: the reference on the CPU, the others on the backend. Errors: those of the passes.
Result<RenderedScene> renderForReport(const Context& context, const Backend& backend, const LoadedSetup& setup,
                                      const ReportSettings& settings);

}  // namespace probegi::tool
