#pragma once

#include <string>
#include <vector>

#include "probegi/measure.h"

namespace probegi::accuracy {

/// How many updates a field takes to follow one change of the light.
struct Reaction {
    std::string change;  ///< "x0.1", "sun jump", ...
    int updates = 0;  ///< after which the mean irradiance stays within a tenth of the change around its goal; -1: never
};

/// A scene in which the light changes: how fast `update()` follows, and how much it flickers while nothing changes.
struct MotionResult {
    std::string scene;
    FieldRules rules = FieldRules::measured;
    int probes = 0;
    int rays = 0;        ///< per probe and update
    double settled = 0;  ///< mean irradiance after kSettledUpdates updates over that of `converge`
    Flicker flicker{};   ///< at surface points
    std::vector<Reaction> reactions{};
    std::string missing{};  ///< why the scene could not be measured; empty: it was
};

/// How much to measure of a scene.
enum class MotionScope {
    still,    ///< settled light and flicker
    changes,  ///< reactions as well
};

inline constexpr int kSettledUpdates = 300;

/// Measures a scene on the grid of the desc, with its lights in the rest pose. Errors: those of Field.
Result<MotionResult> measureMotion(const Context& context, const std::string& name, const Scene& scene,
                                   const FieldDesc& desc, MotionScope scope);

/// The table for docs/accuracy.md, with its heading.
std::string motionTable(const std::vector<MotionResult>& rows);

}  // namespace probegi::accuracy
