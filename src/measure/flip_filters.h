#pragma once

#include <vector>

#include "measure/plane.h"

/// The two kinds of filters of FLIP. All of them are separable: a picture is filtered by rows, then by columns.
namespace probegi::flip {

/// A term of a separable filter: outer product of the same taps along rows and columns, times `weight`.
struct GaussianTerm {
    float weight = 1;
    std::vector<float> taps;  ///< add up to 1
};

/// Contrast sensitivity of one channel, as a sum of Gaussians whose weights add up to 1 (section 4.1.1, Table 1).
using ContrastFilter = std::vector<GaussianTerm>;

struct ContrastFilters {
    ContrastFilter luminance;   ///< Y
    ContrastFilter redGreen;    ///< Cx
    ContrastFilter yellowBlue;  ///< Cz
};

ContrastFilters contrastFilters(float pixelsPerDegree);
Plane applyFilter(const ContrastFilter& filter, const Plane& plane);

/// Edge and point detectors along one axis: the first and second derivative of a Gaussian there, the Gaussian itself
/// across (section 4.2). The positive and the negative taps of each detector add up to +1 and -1.
struct FeatureFilters {
    std::vector<float> gaussian;  ///< adds up to 1
    std::vector<float> edge;
    std::vector<float> point;
};

FeatureFilters featureFilters(float pixelsPerDegree);

/// How much edge or point there is at each pixel: the length of the detector's responses along x and along y.
Plane featureStrength(const Plane& luminance, const std::vector<float>& detector, const std::vector<float>& gaussian);

}  // namespace probegi::flip
