#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "field/wall_frame.h"

namespace probegi {

/// A point on a surface across an axis.
struct WallPoint {
    float place;  ///< along the axis, metres
    bool up;      ///< the surface faces up the axis, else down it
};

/// Surfaces visible from inside a scene's bounds, by rays from points spread over these, except those in solid matter:
/// a wall counts by its area and by the open space in front of it. Deterministic. Errors: those of the tracer.
Result<std::vector<WallSample>> findWalls(const Tracer& tracer);

/// Those across an axis, a unit vector.
std::vector<WallPoint> wallsAcross(std::span<const WallSample> samples, glm::vec3 axis);

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
