#pragma once

#include <cstddef>
#include <glm/geometric.hpp>

#include "probegi/field.h"

namespace probegi {

/// Farthest distance that visibility distinguishes, in diagonals of a grid cell: a point's eight probes are at most one
/// diagonal away; the rest leaves room for the moments' spread.
inline constexpr float kMaxDistanceInDiagonals = 1.5f;

/// Minimum probe spacing, metres.
inline constexpr float kSmallestSpacing = 1e-6f;
inline constexpr float kLargestSpacing = 1e9f;

/// Sizes that follow from a FieldDesc. A probe's texels are contiguous, row by row, without a border: on the CPU
/// octWrapTexel finds border texels instead of storing them twice.
struct FieldLayout {
    explicit FieldLayout(const FieldDesc& d)
        : probes(std::size_t(probeCount(d.grid))),
          rays(std::size_t(d.raysPerProbe)),
          irradianceTexels(std::size_t(d.irradianceTexels) * d.irradianceTexels),
          visibilityTexels(std::size_t(d.visibilityTexels) * d.visibilityTexels),
          maxDistance(kMaxDistanceInDiagonals * glm::length(d.grid.spacing)) {}

    std::size_t probes;
    std::size_t rays;              ///< a probe
    std::size_t irradianceTexels;  ///< a probe
    std::size_t visibilityTexels;  ///< a probe
    float maxDistance;             ///< metres; stored distances are fractions of it
};

/// Checks every member. Errors: invalidArgument.
Result<void> validateFieldDesc(const FieldDesc& desc);

}  // namespace probegi
