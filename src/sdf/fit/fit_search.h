#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "core/progress.h"
#include "sdf/fit/fit_boxes.h"

namespace probegi {

/// How boxes are looked for. All that is not a limit was chosen by trial.
struct FitSearch {
    std::span<const FitRay> rays;  ///< in the world
    std::span<const FitSurface> surfaces;
    std::span<const float> ends;  ///< as those of FitBoxes
    std::span<const glm::mat3> frames;
    FitCost cost;
    int most = 64;         ///< boxes
    int resolution = 128;  ///< cubes along the longest side
    int rounds = 24;       ///< in which some boxes are taken away and others put in
    std::uint32_t seed = 1;
};

/// The boxes among which the rays end as in the scene, as nearly as was found. Fewer than `most` where more would not
/// help. Deterministic. Ends early, with what there is, once the progress was cancelled.
std::vector<FitBox> findBoxes(const Context& context, const FitSearch& search, Progress& progress);

}  // namespace probegi
