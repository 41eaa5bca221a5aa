#pragma once

#include <istream>
#include <string>
#include <vector>

#include "probegi/scene.h"

namespace probegi::io {

/// Adds the settings of a file of NVIDIA's RTXGI test harness to a scene: lights, cameras, sky and all probe grids.
/// Returns a sentence for each ignored setting that affects a probe grid: scrolling, and a volume without probeCounts.
/// Throws Refused for a value that cannot be read.
///
/// Conventions of these files: yaw and pitch in degrees, forward = (sin yaw, 0, -cos yaw) at pitch 0, positive pitch
/// looks down, fov vertical; light type 0 directional, 1 spot, 2 point, directions of any length, cone angles in
/// degrees from the axis, color x power is our intensity; the grid's origin is its centre (ours: its first probe), its
/// rotation in degrees about its own x, then the outer y, then the outer z axis (assumed; the files at hand have none).
std::vector<std::string> addHarnessSettings(std::istream& settings, Scene& scene);

}  // namespace probegi::io
