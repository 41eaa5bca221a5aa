#pragma once

#include "probegi/context.h"
#include "probegi/result.h"

namespace probegi::accuracy {

/// Mean indirect irradiance on the walls of the sealed room, which is really black, over that on the walls of the
/// sunlit room beside it. Probes are 1 m apart. Leaks depend on where the wall cuts the grid, so several shifts of the
/// grid are measured.
struct LeakShare {
    double mean = 0;   ///< over the grid's shifts
    double worst = 0;  ///< of the grid's shifts
};

/// Number of Field::update calls, the way engines fill a field, before measuring.
inline constexpr int kRealtimeUpdates = 300;

struct LeakResult {
    float wallThickness = 0;  ///< metres
    LeakShare leaky;          ///< LeakGuard::none, converged
    LeakShare moments;        ///< LeakGuard::moments, converged
    LeakShare relocated;      ///< the same with relocated probes
    LeakShare realtime;       ///< LeakGuard::moments after kRealtimeUpdates of Field::update
};

/// Errors: those of the field and its tracer.
Result<LeakResult> measureLeak(const Context& context, float wallThickness);

}  // namespace probegi::accuracy
