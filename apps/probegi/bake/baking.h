#pragma once

#include <chrono>

#include "probegi/field_file.h"
#include "render_options.h"

namespace probegi::tool {

/// Options of `probegi bake` besides those of fields.
struct BakeOptions {
    RenderOptions render;  ///< what it shares with `probegi render`
    bool resume = false;
    double checkpointSeconds = 30;
};

/// Seconds of each stage in this run, and what came of it.
struct BakeReport {
    double maskSeconds = 0, lightSeconds = 0, fileSeconds = 0;
    int updates = 0;        ///< of this run
    int updatesBefore = 0;  ///< of the runs that it goes on from
    FieldRun run;           ///< this run's updates
    std::uint64_t fileBytes = 0;
    FieldMemory memory;
    std::optional<MaskReport> masks;  ///< with times only if they were baked in this run
};

/// The file beside a bake's output that keeps what there is so far. Empty: a device or a pipe has nothing beside it.
std::string partFileOf(const std::string& output);

/// Bakes a field: masks, then light. From time to time all that there is goes to partFileOf() the output, from which
/// another run goes on; where it cannot be written, that is a warning.
class Baking {
public:
    /// All must outlive it. `tracer`: the triangles; `probes`: what probe rays hit.
    Baking(const Context& context, const Backend& backend, const LoadedSetup& setup, const BakeOptions& options,
           const Tracer& tracer, const Tracer& probes)
        : m_context(context),
          m_backend(backend),
          m_setup(setup),
          m_options(options),
          m_tracer(tracer),
          m_probes(probes),
          m_partFile(partFileOf(options.render.output)) {}

    /// Errors: of the options (--resume without a file, or one of another bake), the field, the files.
    Result<BakeReport> run();

private:
    using Clock = std::chrono::steady_clock;

    Result<void> begin();
    Result<bool> takeUp();
    Result<void> bakeMasksOnce();
    Result<void> light();
    Result<void> updates();
    Result<void> converge();
    int placingUpdates() const;
    void checkpoint();
    void checkpointNowAndThen();
    Result<void> finish();

    const Context& m_context;
    const Backend& m_backend;
    const LoadedSetup& m_setup;
    const BakeOptions& m_options;
    const Tracer &m_tracer, &m_probes;
    const std::string m_partFile;
    bool m_warned = false;  // that a checkpoint failed
    std::optional<Field> m_field;
    FieldProvenance m_provenance;
    ConvergeState m_convergence;
    BakeReport m_report;
    Clock::time_point m_lastCheckpoint{};
};

/// How a field is baked, so that two bakes of one recipe, one scene and the same settings are one.
std::string recipeOf(const BakeOptions& options, const LoadedSetup& setup);

}  // namespace probegi::tool
