#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "animation/frame_times.h"
#include "aov.h"
#include "backend.h"
#include "field_run.h"
#include "mask_options.h"
#include "probegi/reference.h"
#include "scene_setup.h"

namespace probegi::tool {

/// Where indirect light comes from. `sdfddgi` stands for `ddgi` with other options until the command line is read.
enum class Method { none, leaky, ddgi, sdfddgi, reference };

inline constexpr int kDefaultReferenceSamples = 64;

/// Updates between two pictures of --animate (docs/accuracy.md, "Moving things").
inline constexpr int kDefaultUpdatesPerFrame = 4;

/// All options of `probegi render`. The strings have passed their parsers.
struct RenderOptions {
    SceneOptions scene;
    BackendOptions backend;
    std::string output, stats;
    Method method = Method::ddgi;
    FieldRules rules = FieldRules::measured;
    Aov aov = Aov::color;
    std::string size = "960x540";
    int antialias = 2;
    bool diffuseOnly = false;
    Glossy glossy = Glossy::off;
    bool contact = false;
    bool filmic = false;
    std::uint64_t seed = 1;
    int rays = FieldDesc{}.raysPerProbe;
    FieldRunOptions run;
    std::optional<int> samplesPerPixel;
    std::optional<double> seconds;
    bool guide = false;
    bool relocation = false, probeStates = false;
    MaskOptions masks;
    std::string field;    ///< --field: a file with the probes; empty: they are filled
    std::string debug;    ///< name of a DebugView; empty: a picture
    std::string animate;  ///< empty: one picture
    std::optional<int> updatesPerFrame;
    bool events = true;  ///< --events
    std::string budget;  ///< --budget; empty: none
};

/// Adds --rules, --rays, --relocation and --probe-states.
void addProbeOptions(CLI::App& command, RenderOptions& options);

/// FieldSettings::visibilityExponent of --rules paper.
inline constexpr float kPaperVisibilityExponent = 50;

/// The setup's settings by what the command line says of rules and method.
FieldSettings fieldSettings(const LoadedSetup& setup, Method method, FieldRules rules);

/// Whether the method has a field of probes.
bool hasProbes(const RenderOptions& options);

PictureDesc pictureDesc(const RenderOptions& options, const LoadedSetup& setup);

/// The field that the options ask for, still empty; none for methods without. `pose`: the setup's, or one with more.
Result<std::optional<Field>> makeEmptyField(const Backend& backend, const LoadedSetup& setup,
                                            const RenderOptions& options, const ScenePose& pose);

/// Gives the field the budget that the options ask for, with the setup's camera as its view. Errors: those of
/// FieldControl::setBudget.
Result<void> setBudget(Field& field, const LoadedSetup& setup, const RenderOptions& options);

/// A path-traced picture of the setup as it is; `guide`: null for none.
Result<ReferencePicture> renderReference(const Context& context, const Tracer& tracer, const LoadedSetup& setup,
                                         const RenderOptions& options, const Field* guide);

}  // namespace probegi::tool
