#pragma once

#include <string>
#include <vector>

#include "probegi/context.h"
#include "probegi/field.h"

namespace probegi::accuracy {

/// builtin:dark-room with one wall and one distance between probes: measured leaks, and what an audit says of them.
struct SweepRow {
    float wall = 0;     ///< thickness, metres
    float spacing = 0;  ///< metres
    int probes = 0;
    LeakGuard guard = LeakGuard::moments;
    double converged = 0;  ///< leakShare() after converge()
    double updated = -1;   ///< the same after kRealtimeUpdates of update(); -1: not measured
    int places = 0;        ///< that an audit of the converged field finds on the dark room's own walls
    double worst = 0;      ///< the largest LeakPlace::leak of those
    double leaked = 0;     ///< light that they leak, W: sum of area times what is too much
};

/// What is swept. The finest grid has 20,000 probes, whose 300 updates take minutes a row.
struct SweepDesc {
    std::vector<float> walls{0.02f, 0.05f, 0.10f, 0.20f, 0.30f};
    std::vector<float> spacings{0.25f, 0.5f, 1.0f, 2.0f};
    float finestUpdated = 0.5f;  ///< spacings below are converged only
};

/// Errors: those of the field, its tracer and the audit.
Result<std::vector<SweepRow>> sweepLeaks(const Context& context, const SweepDesc& desc);

/// The tables for docs/accuracy.md, with their heading; empty without rows.
std::string sweepTables(const std::vector<SweepRow>& rows);

}  // namespace probegi::accuracy
