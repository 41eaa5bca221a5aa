#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// A point on an axis-aligned surface.
struct WallPoint {
    float place;  ///< along the axis, metres
    bool up;      ///< the surface faces up the axis, else down it
};

/// The surfaces visible from inside a scene's bounds.
struct Walls {
    std::array<std::vector<WallPoint>, 3> across;  ///< by axis; other surfaces are in no list
    std::size_t seen = 0;                          ///< all points found, other surfaces included
};

/// Finds them by rays from points spread over the bounds, except those in solid matter: a wall counts by its area and
/// by the open space in front of it. Deterministic. Errors: those of the tracer.
Result<Walls> findWalls(const Tracer& tracer);

/// Positions of the probes along one axis.
struct AxisPlacement {
    float first;    ///< position of the first probe, metres
    float spacing;  ///< metres
};

/// Shifts the probes of an axis by up to half a cell and scales their spacing by a few per cent, so that the first
/// probe in front of the walls is at the best distance. Keeps at least marginCells beyond `lower` and `upper`; returns
/// `placed` unchanged if there are few walls or little to gain.
AxisPlacement fitToWalls(const std::vector<WallPoint>& walls, std::size_t seen, AxisPlacement placed, int count,
                         float lower, float upper, float marginCells);

}  // namespace probegi
