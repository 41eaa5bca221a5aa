#pragma once

#include <string>

#include "probegi/render.h"

namespace probegi::tool {

/// Which layer of a Picture is written.
enum class Aov { color, irradiance, normal, albedo, depth, direct, indirect };

/// The layer as it is written to `path`: linear values for .exr; for .png what makes it readable on a screen (normals
/// as 0.5 + 0.5 n, depth from white to black at the farthest point, irradiance as the light that a white matt surface
/// sends back). `exposure` and the filmic curve act on light only.
Result<void> writeAov(const std::string& path, const Picture& picture, Aov aov, const ToneMap& toneMap);

}  // namespace probegi::tool
