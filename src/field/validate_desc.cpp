#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/sentence.h"
#include "field/layout.h"
#include "kernels/trace/ray_offset.h"

namespace probegi {

namespace {

Result<void> checkRange(const char* name, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return {};
    return fail(ErrorCode::invalidArgument, sentence(name, " is ", value, "; it must be ", lowest, " to ", highest));
}

Result<void> checkMapSize(const char* name, int size, int highest) {
    if (size % 2 == 0) return checkRange(name, size, 4, highest);
    return fail(ErrorCode::invalidArgument, sentence(name, " is ", size, "; it must be even"));
}

/// Rays leave a surface at an offset proportional to the rounding of coordinates there; it must be small relative to
/// the probe spacing too, or light is lost.
Result<void> checkDistance(const GridDesc& grid) {
    constexpr float kMostOfSpacing = 0.25f;
    const glm::vec3 last = grid.origin + grid.spacing * glm::vec3(grid.counts - 1);
    const glm::vec3 corner = glm::max(glm::abs(grid.origin), glm::abs(last));
    const float closest = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    if (kernels::rayOffset(corner, 0.0f) <= kMostOfSpacing * closest) return {};
    return fail(ErrorCode::invalidArgument,
                sentence("the probe grid reaches ", std::max({corner.x, corner.y, corner.z}),
                         " m from the origin, where coordinates are too coarse for probes ", closest,
                         " m apart; move the scene to the origin, or increase the spacing"));
}

Result<void> checkGrid(const GridDesc& grid) {
    std::int64_t probes = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(grid.origin[axis])) return fail(ErrorCode::invalidArgument, "grid.origin is not finite");
        if (auto ok = checkRange("grid.spacing", grid.spacing[axis], kSmallestSpacing, kLargestSpacing); !ok) return ok;
        if (auto ok = checkRange("grid.counts", grid.counts[axis], 2, 1024); !ok) return ok;
        probes *= grid.counts[axis];
    }
    if (auto ok = checkDistance(grid); !ok) return ok;
    return checkRange("the number of probes in the grid", double(probes), 8, 1 << 24);
}

}  // namespace

Result<void> validateFieldDesc(const FieldDesc& d) {
    return checkGrid(d.grid)
        .and_then([&] { return checkRange("raysPerProbe", d.raysPerProbe, 8, 4096); })
        .and_then([&] { return checkRange("fixedRays", d.fixedRays, 0, 256); })
        .and_then([&] { return checkMapSize("irradianceTexels", d.irradianceTexels, 32); })
        .and_then([&] { return checkMapSize("visibilityTexels", d.visibilityTexels, 64); })
        .and_then([&] { return checkRange("hysteresis", d.hysteresis, 0, 0.999f); })
        .and_then([&] { return checkRange("visibilityHysteresis", d.visibilityHysteresis, 0, 0.999f); })
        .and_then([&] { return checkRange("visibilityExponent", d.visibilityExponent, 1, 500); })
        .and_then([&] { return checkRange("selfShadowBias", d.selfShadowBias, 0, 2); })
        .and_then([&] { return checkRange("significantChange", d.significantChange, 0, 1); })
        .and_then([&] { return checkRange("newDistribution", d.newDistribution, 0, 1); })
        .and_then([&] { return checkRange("emitterSamples", d.emitterSamples, 0, 16); });
}

}  // namespace probegi
