#include "kernels/screen/glossy_blur.h"

#include <gtest/gtest.h>

namespace probegi::kernels {
namespace {

constexpr float kPixel = 2e-3f;  // radians

GlossyGuide floorAt(vec3 position) {
    return {position, {0, 1, 0}, {0, 1, 0}, 0.3f, 4.0f};
}

TEST(GlossyBlur, mirrorsStaySharp) {
    EXPECT_LE(glossyBlurRadius(0.0f, 1.0f, kPixel), 1.0f);
    EXPECT_LE(glossyBlurRadius(0.03f, 1.0f, kPixel), 1.0f);
    EXPECT_GT(glossyBlurRadius(0.2f, 1.0f, kPixel), 1.0f);
}

TEST(GlossyBlur, widensWithRoughnessAndReach) {
    float last = 0;
    for (const float roughness : {0.1f, 0.15f, 0.2f, 0.25f}) {
        const float radius = glossyBlurRadius(roughness, 0.4f, kPixel);
        EXPECT_GT(radius, last);
        last = radius;
    }
    EXPECT_NEAR(glossyBlurRadius(0.2f, 0.25f, kPixel), 0.5f * glossyBlurRadius(0.2f, 0.5f, kPixel), 1e-5f);
    EXPECT_EQ(glossyBlurRadius(1.0f, 1.0f, kPixel), kGlossyWidest);
    EXPECT_EQ(glossyBlurRadius(0.5f, 0.0f, kPixel), 0.0f);
}

TEST(GlossyBlur, theWideOneSetsInWhereTheNarrowOneEnds) {
    EXPECT_EQ(glossyStep(3.0f), 0.0f);
    EXPECT_EQ(glossyStep(15.0f), 5.0f);
    EXPECT_EQ(glossyWideShare(3.0f), 0.0f);
    EXPECT_NEAR(glossyWideShare(3.25f), 0.25f, 1e-6f);
    EXPECT_EQ(glossyWideShare(9.0f), 1.0f);
    EXPECT_EQ(glossyOffset(3, 5.0f), 15);
    EXPECT_EQ(glossyOffset(-3, 1.2f), -4);
    EXPECT_EQ(glossyOffset(0, 4.7f), 0);
}

TEST(GlossyBlur, weightsFallToNothingAtTheRadius) {
    EXPECT_EQ(glossyFalloff(0.0f, 3.0f), 1.0f);
    EXPECT_EQ(glossyFalloff(3.0f, 3.0f), 0.0f);
    EXPECT_EQ(glossyFalloff(5.0f, 3.0f), 0.0f);
    EXPECT_GT(glossyFalloff(1.0f, 3.0f), glossyFalloff(2.0f, 3.0f));
}

TEST(GlossyBlur, samplesOfOnePlaneStandForEachOther) {
    EXPECT_EQ(guideWeight(floorAt({0, 0, 0}), floorAt({0.3f, 0, -0.2f}), 10.0f, kPixel), 1.0f);
}

TEST(GlossyBlur, doesNotCrossEdges) {
    const GlossyGuide centre = floorAt({0, 0, 0});
    // 10 pixels of 8 mm away: a step of 5 cm.
    EXPECT_EQ(guideWeight(centre, floorAt({0.08f, 0.05f, 0}), 10.0f, kPixel), 0.0f);
    GlossyGuide turned = floorAt({0.08f, 0, 0});
    turned.shadingNormal = normalize(vec3(0.3f, 1, 0));
    EXPECT_EQ(guideWeight(centre, turned, 10.0f, kPixel), 0.0f);
    GlossyGuide rougher = floorAt({0.08f, 0, 0});
    rougher.roughness = 0.41f;
    EXPECT_EQ(guideWeight(centre, rougher, 10.0f, kPixel), 0.0f);
    rougher.roughness = 0.35f;
    EXPECT_NEAR(guideWeight(centre, rougher, 10.0f, kPixel), 0.5f, 1e-5f);
}

// Bilinear between the rays of a regular grid; their own pixels have theirs alone.
TEST(GlossyBlur, tentsInterpolate) {
    EXPECT_EQ(glossyTent(0, 0), 1.0f);
    EXPECT_EQ(glossyTent(2, 0), 0.0f);
    EXPECT_EQ(glossyTent(0, -2), 0.0f);
    EXPECT_EQ(glossyTent(1, 0) + glossyTent(-1, 0), 1.0f);
    EXPECT_EQ(4 * glossyTent(1, -1), 1.0f);
}

TEST(GlossyBlur, aConstantStaysItself) {
    const vec3 value(0.1f, 1.7f, 3.3e5f);
    GlossyMean mean = glossyMean(value, 1.0f);
    for (int i = 0; i < 48; ++i) addTap(mean, value, 0.013f * float(i));
    EXPECT_EQ(meanOf(mean), value);
}

TEST(GlossyBlur, meansAreWeighted) {
    GlossyMean mean = glossyMean(vec3(1.0f), 1.0f);
    addTap(mean, vec3(5.0f), 3.0f);
    EXPECT_NEAR(meanOf(mean).x, 4.0f, 1e-6f);
    GlossyMean none = glossyMean(vec3(7.0f), 0.0f);
    EXPECT_EQ(meanOf(none), vec3(7.0f));
    addTap(none, vec3(2.0f), 0.5f);
    EXPECT_EQ(meanOf(none), vec3(2.0f));
}

}  // namespace
}  // namespace probegi::kernels
