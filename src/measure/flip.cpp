#include "measure/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "measure/colour_spaces.h"
#include "measure/flip_filters.h"

namespace probegi::flip {

namespace {

constexpr float kColourExponent = 0.7f;   ///< q_c
constexpr float kKneeShare = 0.4f;        ///< p_c: differences below this share of the largest ...
constexpr float kKneeHeight = 0.95f;      ///< p_t: ... are spread over this share of 0..1
constexpr float kFeatureExponent = 0.5f;  ///< q_f

/// Y, Cx and Cz of a display-referred picture.
std::array<Plane, 3> opponentPlanes(const HdrImage& image) {
    std::array<Plane, 3> planes{Plane(image.width, image.height), Plane(image.width, image.height),
                                Plane(image.width, image.height)};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3 v = colour::ycxczFromXyz(colour::xyzFromRgb(colour::decodeSrgb(image.pixels[i])));
        for (int channel = 0; channel < 3; ++channel) planes[channel].values[i] = v[channel];
    }
    return planes;
}

/// Colours look less colourful where it is dark: the Hunt adjustment (section 4.1.2).
glm::vec3 huntLab(glm::vec3 linearRgb) {
    const glm::vec3 lab = colour::labFromXyz(colour::xyzFromRgb(linearRgb));
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

/// City-block distance in lightness, Euclidean in hue and chroma: fit for large differences (section 4.1.3).
float hyab(glm::vec3 a, glm::vec3 b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// Picture as the eye resolves it: filtered by contrast sensitivity, in Hunt-adjusted CIELAB (section 4.1).
std::vector<glm::vec3> perceivedColours(const std::array<Plane, 3>& opponent, const ContrastFilters& filters) {
    const Plane y = applyFilter(filters.luminance, opponent[0]);
    const Plane cx = applyFilter(filters.redGreen, opponent[1]);
    const Plane cz = applyFilter(filters.yellowBlue, opponent[2]);
    std::vector<glm::vec3> colours(y.values.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const glm::vec3 xyz = colour::xyzFromYcxcz({y.values[i], cx.values[i], cz.values[i]});
        colours[i] = huntLab(glm::clamp(colour::rgbFromXyz(xyz), 0.0f, 1.0f));
    }
    return colours;
}

/// Compresses distances to 0..1 so that small ones get most of the range (section 4.1.3). The largest distance in
/// the sRGB gamut is that between blue and green.
class ColourError {
public:
    ColourError() : m_largest(std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), kColourExponent)) {}

    float operator()(glm::vec3 a, glm::vec3 b) const {
        const float error = std::pow(hyab(a, b), kColourExponent);
        const float knee = kKneeShare * m_largest;
        if (error < knee) return kKneeHeight / knee * error;
        return std::min(kKneeHeight + (error - knee) / (m_largest - knee) * (1 - kKneeHeight), 1.0f);
    }

private:
    float m_largest;
};

struct Features {
    Plane edges;
    Plane points;
};

/// Edges and points of the unfiltered luminance, scaled to 0..1 (section 4.2).
Features features(Plane y, const FeatureFilters& filters) {
    for (float& value : y.values) value = (value + 16) / 116;
    return {featureStrength(y, filters.edge, filters.gaussian), featureStrength(y, filters.point, filters.gaussian)};
}

}  // namespace

Plane differenceMap(const HdrImage& test, const HdrImage& reference, float pixelsPerDegree) {
    const auto testPlanes = opponentPlanes(test);
    const auto referencePlanes = opponentPlanes(reference);
    const ContrastFilters contrast = contrastFilters(pixelsPerDegree);
    const auto testColours = perceivedColours(testPlanes, contrast);
    const auto referenceColours = perceivedColours(referencePlanes, contrast);
    const FeatureFilters detectors = featureFilters(pixelsPerDegree);
    const Features testFeatures = features(testPlanes[0], detectors);
    const Features referenceFeatures = features(referencePlanes[0], detectors);

    const ColourError colourError;
    Plane map(test.width, test.height);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const float edge = std::abs(testFeatures.edges.values[i] - referenceFeatures.edges.values[i]);
        const float point = std::abs(testFeatures.points.values[i] - referenceFeatures.points.values[i]);
        const float feature = std::min(std::pow(std::max(edge, point) / std::sqrt(2.0f), kFeatureExponent), 1.0f);
        // Section 4.3: a difference in features raises the difference in colour, and never lowers it.
        map.values[i] = std::pow(colourError(testColours[i], referenceColours[i]), 1 - feature);
    }
    return map;
}

}  // namespace probegi::flip
