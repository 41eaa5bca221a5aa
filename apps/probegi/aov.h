#pragma once

#include <string>

#include "probegi/render.h"

namespace probegi::tool {

/// Which layer of a Picture is written.
enum class Aov { color, irradiance, normal, albedo, depth, direct, indirect };

/// Whether a layer is light, to which exposure and the filmic curve apply.
bool isLight(Aov aov);

/// Writes a layer to `path`: linear values for .exr, a readable picture for .png (normals as 0.5 + 0.5 n, depth from
/// white to black at the farthest point, irradiance as reflected by a white diffuse surface). The tone map applies to
/// light only. Warns if a .png of light is nearly all black.
Result<void> writeAov(const std::string& path, const Picture& picture, Aov aov, const ToneMap& toneMap);

}  // namespace probegi::tool
