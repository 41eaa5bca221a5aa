#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "backend.h"
#include "field_run.h"
#include "probegi/measure.h"
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
    bool allCameras = false;  ///< draw the scene's other cameras too, at half the size
    /// Called before each piece of work, in the order of reportPieces(). Empty: nobody wants to know.
    std::function<void(const std::string& piece)> onPiece{};
};

/// A piece of the work on a report.
struct ReportPiece {
    std::string name;    ///< what is being done, e.g. "path tracing"
    double seconds = 0;  ///< a rough guess
};

/// All pieces of renderForReport(), in order.
std::vector<ReportPiece> reportPieces(const LoadedSetup& setup, const ReportSettings& settings);

/// The cameras that are drawn: the setup's, and with ReportSettings::allCameras the scene's others.
std::vector<PlacedCamera> reportCameras(const LoadedSetup& setup, const ReportSettings& settings);

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

/// One camera's pictures.
struct RenderedView {
    PlacedCamera camera;
    int shrink = 1;      ///< the pictures' sides are the report's over this; the reference's time is over its square
    float exposure = 1;  ///< at which the pictures are shown and their errors measured
    MethodResult none, leaky, ddgi;
    Picture reference;
    HdrImage referenceError;  ///< standard error of the reference's color
    int referenceSamples = 0;
    double referenceSeconds = 0;
    double referenceNoise = 0;   ///< mean standard error over mean value of the picture
    ImageDifference noiseFloor;  ///< what an exact picture would score against this reference, for its noise
    HdrImage noiseMap;           ///< per pixel FLIP of that
    LeakMap leaks;               ///< of the field with its guard
    /// The same of the indirect light alone, with all the noise up to the indirect light itself: what is above, at the
    /// edges of lamps, is direct light's.
    ImageDifference indirectNoiseFloor;
};

/// What a field knows at one of its probes.
struct ProbeSight {
    float backfaceShare = 0;  ///< ProbeState::backfaceShare
    float irradiance = 0;     ///< luminance of E, mean over the six axis directions, W m^-2
};

/// Everything that the report says of one scene: its first camera's view, and what belongs to all.
struct RenderedScene : RenderedView {
    std::size_t triangles = 0;
    std::size_t lights = 0;
    VolumeDesc grid;
    double prepareSeconds = 0;  ///< tracer and light sampling structures
    FieldResult leakyField, ddgiField;
    std::optional<FieldPicture> realtime;  ///< with ReportSettings::realtimeUpdates
    ProbeTruth truth;
    std::vector<ProbeSight> probes;    ///< by index, with the leak guard
    std::vector<RenderedView> others;  ///< the views of the scene's other cameras
};

/// Renders all four pictures: the reference on the CPU, the others on the backend. Errors: those of the passes.
Result<RenderedScene> renderForReport(const Context& context, const Backend& backend, const LoadedSetup& setup,
                                      const ReportSettings& settings);

}  // namespace probegi::tool
