#pragma once

#include <string>

#include "probegi/render.h"

namespace probegi::tool {

/// Which layer of a Picture is written.
enum class Aov { color, irradiance, normal, albedo, depth, direct, indirect };

/// Whether a layer is light, which exposure and the filmic curve act on.
bool isLight(Aov aov);

/// The layer as it is written to `path`: linear values for .exr; for .png what makes it readable on a screen (normals
/// as 0.5 + 0.5 n, depth from white to black at the farthest point, irradiance as the light that a white matt surface
/// sends back). The tone map acts on light only. Warns of a .png of light that is nearly all black.
Result<void> writeAov(const std::string& path, const Picture& picture, Aov aov, const ToneMap& toneMap);

}  // namespace probegi::tool
