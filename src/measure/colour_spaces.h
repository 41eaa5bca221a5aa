#pragma once

#include <glm/vec3.hpp>

/// Colour spaces of the error metrics. White is linear Rec.709 (1, 1, 1), i.e. D65, throughout; XYZ is scaled so that
/// white has Y = 1.
namespace probegi::colour {

/// sRGB transfer function (IEC 61966-2-1) by channel, and its inverse; both expect 0..1.
glm::vec3 decodeSrgb(glm::vec3 display);
glm::vec3 encodeSrgb(glm::vec3 linear);

/// Linear Rec.709 to CIE 1931 XYZ and back.
glm::vec3 xyzFromRgb(glm::vec3 linear);
glm::vec3 rgbFromXyz(glm::vec3 xyz);

/// CIELAB (x = L* 0..100, y = a*, z = b*).
glm::vec3 labFromXyz(glm::vec3 xyz);
glm::vec3 xyzFromLab(glm::vec3 lab);

/// YCxCz, a linear relative of CIELAB in which contrast sensitivity is filtered (Zhang and Wandell 1996):
/// x = Y 0..100 (shifted by -16), y = Cx (red to green), z = Cz (yellow to blue).
glm::vec3 ycxczFromXyz(glm::vec3 xyz);
glm::vec3 xyzFromYcxcz(glm::vec3 ycxcz);

}  // namespace probegi::colour
