#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "probegi/field.h"

namespace probegi::tool {

/// Default of --tolerance. Stricter than Field::converge's own default, which is for engines.
inline constexpr float kConvergeTolerance = 0.01f;
/// Most updates to converge in; the tool warns if they do not suffice.
inline constexpr int kConvergeMaxUpdates = 128;

/// How to fill a field: by Field::converge, or with --frames by that many calls of Field::update.
struct FieldRunOptions {
    std::optional<int> frames;       ///< --frames
    std::optional<float> tolerance;  ///< --tolerance
    /// Called with the progress of --frames, 0..1, instead of drawing a bar. (Field::converge reports to the context.)
    std::function<void(double)> progress{};
};

/// Adds --frames and --tolerance, which exclude each other.
void addFieldRunOptions(CLI::App& command, FieldRunOptions& options);

/// Cost and result of filling a field.
struct FieldRun {
    std::vector<UpdateTimes> updates;
    std::vector<std::size_t> updated;           ///< with --frames: probes of each update
    std::optional<ConvergeResult> convergence;  ///< empty with --frames
};

/// Fills the field. Warns on the console if it has not converged. Errors: those of the updates.
Result<FieldRun> runField(Field& field, const Tracer& tracer, const Lighting& lighting, const FieldRunOptions& options);

/// Warns on the console if it has not converged, and says how far it is.
void warnUnlessConverged(const FieldRun& run, const FieldRunOptions& options);

/// 0 if there are no values.
double mean(const std::vector<std::size_t>& counts);

/// "128 updates; not converged to 1 %: the light of the worst region may still be 3.1 % off".
std::string describeRun(const FieldRun& run, const FieldRunOptions& options);

}  // namespace probegi::tool
