#pragma once

#include "probegi/context.h"
#include "probegi/result.h"

namespace probegi::accuracy {

/// Mean indirect irradiance on the walls of the sealed room over that on the walls of the sunlit room beside it. The
/// sealed room is in truth black. Probes are 1 m apart; leaks depend on how the grid lies to the wall, so it is
/// shifted.
struct LeakShare {
    double mean = 0;   ///< over the grid's shifts
    double worst = 0;  ///< of the grid's shifts
};

/// Updates after which what an engine runs, Field::update, is measured.
inline constexpr int kRealtimeUpdates = 300;

struct LeakResult {
    float wallThickness = 0;  ///< metres
    LeakShare leaky;          ///< LeakGuard::none, converged
    LeakShare moments;        ///< LeakGuard::moments, converged
    LeakShare realtime;       ///< LeakGuard::moments after kRealtimeUpdates of Field::update
};

/// Errors: those of the passes.
Result<LeakResult> measureLeak(const Context& context, float wallThickness);

}  // namespace probegi::accuracy
