#include "measure/colour_spaces.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "kernels/screen/colour.h"

namespace probegi::colour {

namespace {

// Rec. ITU-R BT.709 primaries with white D65 (x = 0.3127, y = 0.3290); the columns are the XYZ of red, green and blue.
constexpr glm::vec3 kRed(0.4123908f, 0.2126390f, 0.0193308f);
constexpr glm::vec3 kGreen(0.3575843f, 0.7151687f, 0.1191948f);
constexpr glm::vec3 kBlue(0.1804808f, 0.0721923f, 0.9505322f);

const glm::mat3& rgbToXyz() {
    static const glm::mat3 matrix(kRed, kGreen, kBlue);
    return matrix;
}

const glm::mat3& xyzToRgb() {
    static const glm::mat3 matrix = glm::inverse(rgbToXyz());
    return matrix;
}

const glm::vec3& white() {
    static const glm::vec3 xyz = kRed + kGreen + kBlue;
    return xyz;
}

// CIE 15: the cube root, continued as a straight line near black.
constexpr float kDelta = 6.0f / 29.0f;

float labCurve(float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29.0f;
}

float labCurveInverse(float f) {
    return f > kDelta ? f * f * f : 3 * kDelta * kDelta * (f - 4.0f / 29.0f);
}

}  // namespace

glm::vec3 decodeSrgb(glm::vec3 v) {
    return {kernels::decodeSrgb(v.x), kernels::decodeSrgb(v.y), kernels::decodeSrgb(v.z)};
}

glm::vec3 encodeSrgb(glm::vec3 v) {
    return {kernels::encodeSrgb(v.x), kernels::encodeSrgb(v.y), kernels::encodeSrgb(v.z)};
}

glm::vec3 xyzFromRgb(glm::vec3 linear) {
    return rgbToXyz() * linear;
}

glm::vec3 rgbFromXyz(glm::vec3 xyz) {
    return xyzToRgb() * xyz;
}

glm::vec3 labFromXyz(glm::vec3 xyz) {
    const glm::vec3 relative = xyz / white();
    const float fx = labCurve(relative.x);
    const float fy = labCurve(relative.y);
    const float fz = labCurve(relative.z);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

glm::vec3 xyzFromLab(glm::vec3 lab) {
    const float fy = (lab.x + 16) / 116;
    const float fx = fy + lab.y / 500;
    const float fz = fy - lab.z / 200;
    return glm::vec3(labCurveInverse(fx), labCurveInverse(fy), labCurveInverse(fz)) * white();
}

glm::vec3 ycxczFromXyz(glm::vec3 xyz) {
    const glm::vec3 relative = xyz / white();
    return {116 * relative.y - 16, 500 * (relative.x - relative.y), 200 * (relative.y - relative.z)};
}

glm::vec3 xyzFromYcxcz(glm::vec3 v) {
    const float y = (v.x + 16) / 116;
    return glm::vec3(y + v.y / 500, y, y - v.z / 200) * white();
}

}  // namespace probegi::colour
