#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// A place on a surface that lies across an axis.
struct WallPoint {
    float place;  ///< along the axis, metres
    bool up;      ///< the surface faces up the axis, else down it
};

/// The surfaces that one sees from inside a scene's bounds.
struct Walls {
    std::array<std::vector<WallPoint>, 3> across;  ///< by axis; what lies across none is in no list
    std::size_t seen = 0;                          ///< all places that were found, those across no axis included
};

/// Finds them by rays from places that are spread over the bounds, those in solid matter left out: a wall counts by its
/// area, and by how much room there is in front of it. The same for the same scene. Errors: those of the tracer.
Result<Walls> findWalls(const Tracer& tracer);

/// Where the probes along one axis stand.
struct AxisPlacement {
    float first;    ///< place of the first probe, metres
    float spacing;  ///< metres
};

/// Moves the probes of an axis, by up to half a cell, and draws them apart or together by a few per cent, so that the
/// first probe in front of the walls stands where it serves them best. Keeps at least marginCells beyond `lower` and
/// `upper`; returns `placed` as it is where there are few walls or little is to be gained.
AxisPlacement fitToWalls(const std::vector<WallPoint>& walls, std::size_t seen, AxisPlacement placed, int count,
                         float lower, float upper, float marginCells);

}  // namespace probegi
