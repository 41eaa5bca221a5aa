#pragma once

#include <string>

#include "probegi/render.h"

namespace probegi::tool {

/// Which layer of a Picture is written.
enum class Aov { color, irradiance, normal, albedo, depth, direct, indirect, glossy, contact, openness };

/// Whether a layer is light, to which exposure and the filmic curve apply.
bool isLight(Aov aov);

/// A layer as a readable picture, linear: normals as 0.5 + 0.5 n, depth from white to black at the farthest point,
/// irradiance (and contact light) as reflected by a white diffuse surface.
HdrImage shownLayer(const Picture& picture, Aov aov);

/// Writes a layer to `path`: linear values for .exr, shownLayer() for .png. The tone map applies to light only. Warns
/// if a .png of light is nearly all black, unless told not to.
Result<void> writeAov(const std::string& path, const Picture& picture, Aov aov, const ToneMap& toneMap,
                      bool warnWhereBlack = true);

}  // namespace probegi::tool
