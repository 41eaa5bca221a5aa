#include "measure/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "measure/colour_spaces.h"
#include "measure/flip_filters.h"

namespace probegi::flip {
namespace {

double total(const std::vector<float>& taps) {
    return std::accumulate(taps.begin(), taps.end(), 0.0);
}

float constantDifference(glm::vec3 a, glm::vec3 b) {
    return differenceMap(HdrImage(24, 24, a), HdrImage(24, 24, b)).values[300];
}

TEST(FlipFilters, contrastFiltersKeepConstants) {
    const ContrastFilters filters = contrastFilters(kPixelsPerDegree);
    Plane plane(50, 40);
    plane.values.assign(plane.values.size(), 7);
    for (const ContrastFilter* filter : {&filters.luminance, &filters.redGreen, &filters.yellowBlue})
        for (const float value : applyFilter(*filter, plane).values) EXPECT_NEAR(value, 7, 1e-4);
}

TEST(FlipFilters, theEyeIsSharperForLightThanForColour) {
    // For a single lit pixel, the result at its place is the filter's middle tap.
    Plane impulse(61, 61);
    impulse.row(30)[30] = 1;
    const ContrastFilters filters = contrastFilters(kPixelsPerDegree);
    const float light = applyFilter(filters.luminance, impulse).row(30)[30];
    const float redGreen = applyFilter(filters.redGreen, impulse).row(30)[30];
    const float yellowBlue = applyFilter(filters.yellowBlue, impulse).row(30)[30];
    EXPECT_GT(light, redGreen);
    EXPECT_GT(redGreen, 5 * yellowBlue);
}

TEST(FlipFilters, wideSupportAtTheUsualDistance) {
    // Three standard deviations of sqrt(0.04 / (2 pi^2)) degrees at 67 pixels a degree: 9.05 pixels.
    EXPECT_EQ(contrastFilters(kPixelsPerDegree).luminance.front().taps.size(), 21u);
    // Three times half of 0.082 degrees: 8.24 pixels.
    EXPECT_EQ(featureFilters(kPixelsPerDegree).edge.size(), 19u);
}

TEST(FlipFilters, detectorsIgnoreConstantsAndAreNormalised) {
    const FeatureFilters filters = featureFilters(kPixelsPerDegree);
    EXPECT_NEAR(total(filters.gaussian), 1, 1e-5);
    EXPECT_NEAR(total(filters.edge), 0, 1e-5);
    EXPECT_NEAR(total(filters.point), 0, 1e-5);
    double magnitude = 0;
    for (const float tap : filters.point) magnitude += std::abs(tap);
    EXPECT_NEAR(magnitude, 2, 1e-5);
}

TEST(FlipFilters, aUnitStepIsAnEdgeOfStrengthOne) {
    // The step is between two pixels; the pixel beside it gets all taps of one sign except its own, which is zero.
    Plane step(40, 40);
    for (int y = 0; y < 40; ++y)
        for (int x = 20; x < 40; ++x) step.row(y)[x] = 1;
    const FeatureFilters filters = featureFilters(kPixelsPerDegree);
    const Plane edges = featureStrength(step, filters.edge, filters.gaussian);
    EXPECT_NEAR(edges.row(20)[20], 1, 1e-4);
    EXPECT_NEAR(edges.row(20)[2], 0, 1e-5);
    EXPECT_NEAR(edges.row(20)[37], 0, 1e-5);
}

TEST(Flip, blackAgainstWhite) {
    // HyAB of black and white is 100; 100^0.7 = 25.119. Of green and blue (Hunt-adjusted) it is about 203, to the 0.7
    // about 41.3, so the result is 0.95 + (25.119 - 16.5) / (41.3 - 16.5) * 0.05 = 0.967.
    EXPECT_NEAR(constantDifference(glm::vec3(0), glm::vec3(1)), 0.967, 0.002);
}

TEST(Flip, blueAgainstGreenIsTheLargestDifference) {
    EXPECT_NEAR(constantDifference({0, 0, 1}, {0, 1, 0}), 1, 1e-4);
    for (const glm::vec3& a : {glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(1, 0, 1), glm::vec3(1)})
        for (const glm::vec3& b : {glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(0)})
            EXPECT_LE(constantDifference(a, b), 1);
}

TEST(Flip, smallGreyStepByHand) {
    // Grey 0.5 and 0.6 on the display: linear 0.21404 and 0.31855, L* 53.389 and 63.223; the difference of 9.834 to the
    // 0.7 is 4.953, times 0.95 / (0.4 * 41.3).
    EXPECT_NEAR(constantDifference(glm::vec3(0.5f), glm::vec3(0.6f)), 0.2850, 0.002);
}

TEST(Flip, missingLineIsWorseThanAFainterOne) {
    HdrImage background(64, 64, glm::vec3(0.5f));
    HdrImage line = background;
    HdrImage fainter = background;
    for (int y = 0; y < 64; ++y) {
        line.at(32, y) = glm::vec3(1);
        fainter.at(32, y) = glm::vec3(0.75f);
    }
    const float missing = differenceMap(background, line).row(32)[32];
    const float weaker = differenceMap(fainter, line).row(32)[32];
    EXPECT_GT(missing, weaker);
    EXPECT_GT(missing, 0.5f);
    EXPECT_EQ(differenceMap(background, line).row(32)[2], 0) << "no error spreads farther than the filters reach";
}

TEST(Flip, fineCheckersBlurIntoGrey) {
    // Alternating linear 0.3 and 0.7 look like linear 0.5 at this distance, though the RMSE is large.
    HdrImage checkers(48, 48);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) checkers.at(x, y) = colour::encodeSrgb(glm::vec3((x + y) % 2 ? 0.3f : 0.7f));
    const HdrImage grey(48, 48, colour::encodeSrgb(glm::vec3(0.5f)));
    EXPECT_LT(differenceMap(checkers, grey).row(24)[24], 0.02f);
}

}  // namespace
}  // namespace probegi::flip
