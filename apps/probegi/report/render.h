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

/// How to make a report's pictures.
struct ReportSettings {
    int width = 960;
    int height = 540;
    bool diffuseOnly = false;
    int raysPerProbe = FieldDesc{}.raysPerProbe;
    FieldRunOptions run;
    std::optional<int> realtimeUpdates;  ///< if set, also fill a new field by so many calls of Field::update
    double seconds = 45;                 ///< of the reference; 0: no limit
    int samplesPerPixel = 0;             ///< of the reference; 0: no limit
    int ratioProbes = 128;               ///< probes to compare with the reference
    int ratioSamples = 256;              ///< paths per probe and direction
    std::uint64_t seed = 1;
    bool allCameras = false;  ///< draw the scene's other cameras too, at half the size
    /// Called before each piece of work, in the order of reportPieces(). May be empty.
    std::function<void(const std::string& piece)> onPiece{};
};

/// A piece of the work on a report.
struct ReportPiece {
    std::string name;    ///< what is being done, e.g. "path tracing"
    double seconds = 0;  ///< roughly
};

/// All pieces of renderForReport(), in order.
std::vector<ReportPiece> reportPieces(const LoadedSetup& setup, const ReportSettings& settings);

/// The cameras to draw: the setup's, and with ReportSettings::allCameras the scene's others.
std::vector<PlacedCamera> reportCameras(const LoadedSetup& setup, const ReportSettings& settings);

/// A picture by one method, and how far it is from the reference.
struct MethodResult {
    Picture picture;
    double pictureMs = 0;
    Comparison whole;              ///< of the picture
    ImageDifference indirectOnly;  ///< of the indirect light alone
};

/// What filling a field cost, and how its probes compare with the reference.
struct FieldResult {
    FieldRun run;
    std::string description;  ///< of the run, for tables
    double seconds = 0;       ///< all updates
    UpdateTimes update;       ///< medians, milliseconds
    FieldMemory memory;
    Percentiles ratio;  ///< probe irradiance over the reference's
};

/// A filled field's results, and the picture with it.
struct FieldPicture {
    FieldResult field;
    MethodResult method;
};

/// One camera's pictures.
struct RenderedView {
    PlacedCamera camera;
    int shrink = 1;      ///< the sides are the report's divided by this, the reference's time by its square
    float exposure = 1;  ///< to show the pictures and measure their errors
    MethodResult none, leaky, ddgi;
    Picture reference;
    HdrImage referenceError;  ///< standard error of the reference's color
    int referenceSamples = 0;
    double referenceSeconds = 0;
    double referenceNoise = 0;   ///< mean standard error over mean value of the picture
    ImageDifference noiseFloor;  ///< what an exact picture would score against this reference due to its noise
    HdrImage noiseMap;           ///< per pixel FLIP of that
    LeakMap leaks;               ///< of the field with its guard
    HdrImage hiddenLeaks;        ///< drawLeaks(): what probes behind geometry bring and take
    /// The same for the indirect light alone. Noise is counted up to the indirect light itself: what exceeds it, at the
    /// edges of lamps, is noise of the direct light.
    ImageDifference indirectNoiseFloor;
};

/// A field's values at one of its probes.
struct ProbeSight {
    float backfaceShare = 0;  ///< ProbeState::backfaceShare
    float irradiance = 0;     ///< luminance of E, mean over the six axis directions, W m^-2
};

/// Everything about one scene: its first camera's view, and what all views share.
struct RenderedScene : RenderedView {
    std::size_t triangles = 0;
    std::size_t lights = 0;
    VolumeDesc grid;
    double prepareSeconds = 0;  ///< tracer and light sampling structures
    FieldResult leakyField, ddgiField;
    std::optional<FieldPicture> realtime;  ///< with ReportSettings::realtimeUpdates
    ProbeTruth truth;
    std::vector<ProbeSight> probes;    ///< by index, with the leak guard
    LeakAudit audit;                   ///< of the field with its guard, all over the scene
    AuditDesc auditDesc;               ///< how it was made; its path tracer is gone
    glm::vec3 origin{0.0f};            ///< Scene::origin
    std::vector<RenderedView> others;  ///< the views of the scene's other cameras
};

/// Renders all pictures: the reference on the CPU, the others on the backend. Errors: those of the passes.
Result<RenderedScene> renderForReport(const Context& context, const Backend& backend, const LoadedSetup& setup,
                                      const ReportSettings& settings);

}  // namespace probegi::tool
