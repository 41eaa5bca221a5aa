#include "field_run.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "console/parse.h"
#include "console/terminal.h"

namespace probegi::tool {

namespace {

float toleranceOf(const FieldRunOptions& options) {
    return options.tolerance.value_or(kConvergeTolerance);
}

std::string remainingText(const ConvergeResult& result) {
    if (!std::isfinite(result.remaining)) return "too few updates to tell how much light is missing";
    if (result.remaining > 1) return "the light of the worst region may still be more than 100 % off";
    return fmt::format("the light of the worst region may still be {:.2g} % off", 100 * result.remaining);
}

Result<FieldRun> updateField(Field& field, const Tracer& tracer, const Lighting& lighting,
                             const FieldRunOptions& options) {
    FieldRun run;
    const int frames = *options.frames;
    std::optional<LoopProgress> bar;
    if (!options.progress) bar.emplace("updating probes", frames);
    for (int frame = 0; frame < frames; ++frame) {
        if (bar) bar->done(frame);
        if (options.progress) options.progress(double(frame) / frames);
        const std::size_t probes = field.control().tasks().size();
        const auto times = field.update(tracer, lighting);
        if (!times) return times.error();
        run.updates.push_back(*times);
        run.updated.push_back(probes);
    }
    return run;
}

}  // namespace

void addFieldRunOptions(CLI::App& command, FieldRunOptions& options) {
    auto* frames =
        command
            .add_option("--frames", options.frames,
                        "fill the probes as an engine does, by N real-time updates in which old light fades slowly "
                        "(default: average a still scene until converged)")
            ->type_name("N")
            ->check(inRange(1, 1e6));
    command
        .add_option("--tolerance", options.tolerance,
                    fmt::format("converged when the light of every region is within this share, 0.0001 to 1 (default "
                                "{}; stops after {} updates)",
                                kConvergeTolerance, kConvergeMaxUpdates))
        ->type_name("SHARE")
        ->check(inRange(1e-4, 1))
        ->excludes(frames);
}

Result<FieldRun> runField(Field& field, const Tracer& tracer, const Lighting& lighting,
                          const FieldRunOptions& options) {
    if (options.frames) return updateField(field, tracer, lighting, options);
    FieldRun run;
    const auto record = [&](const UpdateTimes& times) { run.updates.push_back(times); };
    const auto done = field.converge(tracer, lighting, toleranceOf(options), kConvergeMaxUpdates, record);
    if (!done) return done.error();
    run.convergence = *done;
    warnUnlessConverged(run, options);
    return run;
}

void warnUnlessConverged(const FieldRun& run, const FieldRunOptions& options) {
    if (!run.convergence || run.convergence->converged) return;
    printWarning(
        fmt::format("the probes have not converged to {:.2g} % after {} updates: {}; give more --rays or "
                    "a larger --tolerance",
                    100 * toleranceOf(options), run.convergence->updates, remainingText(*run.convergence)));
}

double mean(const std::vector<std::size_t>& counts) {
    return counts.empty() ? 0.0 : std::accumulate(counts.begin(), counts.end(), 0.0) / double(counts.size());
}

std::string describeRun(const FieldRun& run, const FieldRunOptions& options) {
    if (!run.convergence) return fmt::format("{} real-time updates", run.updates.size());
    const std::string ending = run.convergence->converged ? "converged to" : "not converged to";
    return fmt::format("{} updates; {} {:.2g} %: {}", run.updates.size(), ending, 100 * toleranceOf(options),
                       remainingText(*run.convergence));
}

}  // namespace probegi::tool
