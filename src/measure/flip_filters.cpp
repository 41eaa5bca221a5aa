#include "measure/flip_filters.h"

#include <cmath>
#include <numbers>

namespace probegi::flip {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Table 1: the spatial filter is the sum of two terms a * sqrt(pi / b) * exp(-pi^2 x^2 / b), x in degrees.
struct ContrastParameters {
    float a1, b1, a2, b2;
};
constexpr ContrastParameters kLuminance{1.0f, 0.0047f, 0.0f, 1e-5f};
constexpr ContrastParameters kRedGreen{1.0f, 0.0053f, 0.0f, 1e-5f};
constexpr ContrastParameters kYellowBlue{34.1f, 0.04f, 13.5f, 0.025f};

/// Width of a feature detector in degrees of visual angle (section 4.2); sigma is half of it.
constexpr float kFeatureWidth = 0.082f;

std::vector<float> gaussianTaps(int radius, float sigma) {
    std::vector<float> taps(std::size_t(2 * radius + 1));
    for (int i = -radius; i <= radius; ++i)
        taps[std::size_t(i + radius)] = std::exp(-float(i * i) / (2 * sigma * sigma));
    return taps;
}

float sum(const std::vector<float>& taps) {
    float total = 0;
    for (const float tap : taps) total += tap;
    return total;
}

/// exp(-pi^2 x^2 / b) is a Gaussian of variance b / (2 pi^2); the result is in pixels.
float sigmaInPixels(float b, float pixelsPerDegree) {
    return std::sqrt(b / (2 * kPi * kPi)) * pixelsPerDegree;
}

ContrastFilter contrastFilter(const ContrastParameters& p, int radius, float pixelsPerDegree) {
    ContrastFilter filter;
    float total = 0;
    for (const auto& [a, b] : {std::pair(p.a1, p.b1), std::pair(p.a2, p.b2)}) {
        if (a == 0) continue;
        GaussianTerm term{0, gaussianTaps(radius, sigmaInPixels(b, pixelsPerDegree))};
        const float side = sum(term.taps);
        for (float& tap : term.taps) tap /= side;
        // The sampled two-dimensional term adds up to side^2: normalise all terms together to keep their balance.
        term.weight = a * std::sqrt(kPi / b) * side * side;
        total += term.weight;
        filter.push_back(std::move(term));
    }
    for (GaussianTerm& term : filter) term.weight /= total;
    return filter;
}

void normaliseSigns(std::vector<float>& taps) {
    float positive = 0;
    float negative = 0;
    for (const float tap : taps) (tap > 0 ? positive : negative) += std::abs(tap);
    for (float& tap : taps) tap /= tap > 0 ? positive : std::max(negative, 1e-20f);
}

}  // namespace

ContrastFilters contrastFilters(float pixelsPerDegree) {
    // All channels use the support of the widest Gaussian, three standard deviations.
    const int radius = int(std::ceil(3 * sigmaInPixels(kYellowBlue.b1, pixelsPerDegree)));
    return {contrastFilter(kLuminance, radius, pixelsPerDegree), contrastFilter(kRedGreen, radius, pixelsPerDegree),
            contrastFilter(kYellowBlue, radius, pixelsPerDegree)};
}

Plane applyFilter(const ContrastFilter& filter, const Plane& plane) {
    Plane out(plane.width, plane.height);
    for (const GaussianTerm& term : filter) {
        const Plane filtered = filterColumns(filterRows(plane, term.taps), term.taps);
        for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += term.weight * filtered.values[i];
    }
    return out;
}

FeatureFilters featureFilters(float pixelsPerDegree) {
    const float sigma = 0.5f * kFeatureWidth * pixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma));
    FeatureFilters filters;
    filters.gaussian = gaussianTaps(radius, sigma);
    filters.edge = filters.gaussian;
    filters.point = filters.gaussian;
    for (int i = -radius; i <= radius; ++i) {
        filters.edge[std::size_t(i + radius)] *= -float(i);
        filters.point[std::size_t(i + radius)] *= float(i * i) / (sigma * sigma) - 1;
    }
    const float total = sum(filters.gaussian);
    for (float& tap : filters.gaussian) tap /= total;
    normaliseSigns(filters.edge);
    normaliseSigns(filters.point);
    return filters;
}

Plane featureStrength(const Plane& luminance, const std::vector<float>& detector, const std::vector<float>& gaussian) {
    const Plane alongX = filterColumns(filterRows(luminance, detector), gaussian);
    const Plane alongY = filterColumns(filterRows(luminance, gaussian), detector);
    Plane strength(luminance.width, luminance.height);
    for (std::size_t i = 0; i < strength.values.size(); ++i)
        strength.values[i] = std::hypot(alongX.values[i], alongY.values[i]);
    return strength;
}

}  // namespace probegi::flip
