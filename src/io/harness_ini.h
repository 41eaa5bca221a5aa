#pragma once

#include <istream>
#include <string>
#include <vector>

#include "probegi/scene.h"

namespace probegi::io {

/// Adds what a settings file of NVIDIA's RTXGI test harness says to a scene: lights, cameras, sky and the first probe
/// grid. A file without any of these changes nothing. Returns a sentence for each thing in it that changes how a probe
/// grid lies and is ignored: further volumes, a turned volume, a volume that scrolls. Throws Refused for a value that
/// cannot be read.
///
/// Conventions of that file: yaw and pitch in degrees, forward = (sin yaw, 0, -cos yaw) at pitch 0, positive pitch
/// looks down, fov vertical; light type 0 directional, 1 spot, 2 point, directions of any length, cone angles in
/// degrees from the axis, color x power is our intensity; the grid's origin is its centre (ours is its first probe).
std::vector<std::string> addHarnessSettings(std::istream& settings, Scene& scene);

}  // namespace probegi::io
