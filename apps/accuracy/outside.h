#pragma once

#include <array>
#include <string>
#include <vector>

#include "probegi/measure.h"

namespace probegi::accuracy {

/// Light outside of a volume over the path tracer's, by what is taken for it.
struct OutsideResult {
    std::string scene;
    std::string assumed{};                ///< "nearest", "black", "sky"
    std::array<SurfaceError, 4> error{};  ///< by the distance in cells: inside, up to 0.5, up to 1.5, farther
    std::string missing{};                ///< why the scene could not be measured; empty: it was
};

/// A volume over the inner half of each side of a scene, and surface points of all of it. Errors: those of Field, the
/// tracers and the placement.
Result<std::vector<OutsideResult>> measureOutside(const Context& context, const std::string& name, const Scene& scene);

/// The table for docs/accuracy.md, with its heading.
std::string outsideTable(const std::vector<OutsideResult>& rows);

}  // namespace probegi::accuracy
