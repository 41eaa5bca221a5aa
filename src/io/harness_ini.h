#pragma once

#include <istream>

#include "probegi/scene.h"

namespace probegi::io {

/// Adds what a settings file of NVIDIA's RTXGI test harness says to a scene: lights, cameras, sky and the first probe
/// grid. A file without any of these changes nothing. Throws Refused for a value that cannot be read.
///
/// Conventions of that file: yaw and pitch in degrees, forward = (sin yaw, 0, -cos yaw) at pitch 0, positive pitch
/// looks down, fov vertical; light type 0 directional, 1 spot, 2 point, directions of any length, cone angles in
/// degrees from the axis, color x power is our intensity; the grid's origin is its centre (ours is its first probe).
void addHarnessSettings(std::istream& settings, Scene& scene);

}  // namespace probegi::io
