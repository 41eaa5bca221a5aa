#pragma once

#include "measure/plane.h"
#include "probegi/image.h"

/// LDR-FLIP: how different two pictures look to someone who flips between them on one screen. Written from Andersson,
/// Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
/// Images".
namespace probegi::flip {

/// Where the viewer sits: 0.7 m from a 0.7 m wide screen of 3840 pixels (section 4).
constexpr float kPixelsPerDegree = 67.0f;

/// Per-pixel difference, 0..1, of two display-referred (sRGB 0..1) pictures of the same, non-zero size.
Plane differenceMap(const HdrImage& test, const HdrImage& reference, float pixelsPerDegree = kPixelsPerDegree);

}  // namespace probegi::flip
