#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "probegi/field.h"

namespace probegi::tool {

/// When the tool's pictures count a field as converged, where --tolerance says nothing else. Stricter than
/// Field::converge's own default, which is for engines.
inline constexpr float kConvergeTolerance = 0.01f;
/// The cap; where it is hit, the tool says so.
inline constexpr int kConvergeMaxUpdates = 128;

/// How a field's probes are filled: Field::converge, or so many of Field::update.
struct FieldRunOptions {
    std::optional<int> frames;       ///< --frames
    std::optional<float> tolerance;  ///< --tolerance
    /// Told how much of --frames is done, 0..1, in place of a bar of its own. (Field::converge tells the context.)
    std::function<void(double)> progress{};
};

/// Adds --frames and --tolerance, which exclude each other.
void addFieldRunOptions(CLI::App& command, FieldRunOptions& options);

/// What filling the probes took and came to.
struct FieldRun {
    std::vector<UpdateTimes> updates;
    std::optional<ConvergeResult> convergence;  ///< empty with --frames
};

/// Fills the probes. A cap that is hit is a warning on the console. Errors: those of the updates.
Result<FieldRun> runField(Field& field, const Tracer& tracer, const Lighting& lighting, const FieldRunOptions& options);

/// "128 updates; not converged to 1 %: the light of the worst region may still be 3.1 % off".
std::string describeRun(const FieldRun& run, const FieldRunOptions& options);

}  // namespace probegi::tool
