#pragma once

#include <string>
#include <vector>

#include "probegi/measure.h"

namespace probegi::accuracy {

/// One way to choose the probes of an update, in a scene with a lamp on its way.
struct BudgetRow {
    std::string scene;
    std::string way;           ///< "all probes", "half, in turn", "budget of a quarter", ...
    int probes = 0;            ///< of the field
    double updatedMoving = 0;  ///< probes of an update, mean, while the lamp moves
    double updatedStill = 0;   ///< the same after it has stood for long
    double error = 0;    ///< while it moves: RMS difference from the converged light over its mean, mean of moments
    double settled = 0;  ///< the same after it has stood for long
    Flicker flicker{};   ///< at surface points, while nothing moves
};

/// Measures the ways on a built-in scene, "cornell" or "house". Errors: those of Field.
Result<std::vector<BudgetRow>> measureBudget(const Context& context, const std::string& scene);

/// The table for docs/accuracy.md, with its heading.
std::string budgetTable(const std::vector<BudgetRow>& rows);

}  // namespace probegi::accuracy
