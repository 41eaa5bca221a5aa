#include "kernels/shade/texture.h"

#include <gtest/gtest.h>

#include <limits>

namespace probegi::kernels {
namespace {

TEST(Texture, transformIsTheMatrixsUpperRows) {
    EXPECT_EQ(transformUv({2, 3, 5}, {7, 11, 13}, {1, 10}), vec2(2 + 30 + 5, 7 + 110 + 13));
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(transformUv({1, 0, 0}, {0, 0, 4}, {infinity, 0}).x, 0.0f);
    EXPECT_EQ(transformUv({0, 0, 4}, {0, 1e38f, 0}, {0, -1e38f}), vec2(4, 0));
    EXPECT_EQ(transformUv({1, 0, 0}, {0, 0, 4}, {std::nanf(""), 0}).x, 0.0f);
    EXPECT_EQ(transformUv({1, 0, 0}, {0, 1, 0}, {1e38f, -1e38f}), vec2(1e38f, -1e38f));
}

TEST(Texture, coordinatesFoldIntoTheImage) {
    for (const auto& [u, folded] : {std::pair{0.25f, 0.25f}, {1.25f, 0.25f}, {-0.25f, 0.75f}, {3.0f, 0.0f}})
        EXPECT_EQ(foldCoordinate(u, kWrapRepeat), folded) << u;
    for (const auto& [u, folded] : {std::pair{0.25f, 0.25f}, {1.25f, 1.0f}, {-0.25f, 0.0f}})
        EXPECT_EQ(foldCoordinate(u, kWrapClampToEdge), folded) << u;
    for (const auto& [u, folded] : {std::pair{0.25f, 0.25f},
                                    {1.25f, 0.75f},
                                    {-0.25f, 0.25f},
                                    {2.25f, 0.25f},
                                    {-1.25f, 0.75f},
                                    {1.0f, 1.0f},
                                    {2.0f, 0.0f}})
        EXPECT_EQ(foldCoordinate(u, kWrapMirroredRepeat), folded) << u;
}

TEST(Texture, texelsOutsideRepeatOrStayAtTheEdge) {
    for (const int wrap : {kWrapRepeat, kWrapClampToEdge, kWrapMirroredRepeat})
        for (const int inside : {0, 2, 3}) EXPECT_EQ(wrapTexel(inside, 4, wrap), inside);
    EXPECT_EQ(wrapTexel(-1, 4, kWrapRepeat), 3);
    EXPECT_EQ(wrapTexel(4, 4, kWrapRepeat), 0);
    for (const int wrap : {kWrapClampToEdge, kWrapMirroredRepeat}) {
        EXPECT_EQ(wrapTexel(-1, 4, wrap), 0);
        EXPECT_EQ(wrapTexel(4, 4, wrap), 3);
    }
}

void expectSpan(const TexelSpan& span, int first, int second, float fraction) {
    EXPECT_EQ(span.first, first);
    EXPECT_EQ(span.second, second);
    EXPECT_NEAR(span.fraction, fraction, 1e-6);
}

TEST(Texture, spansAreBetweenTexelCentres) {
    expectSpan(texelSpan(0.5f, 4, kWrapClampToEdge, false), 1, 2, 0.5f);
    expectSpan(texelSpan(0.4375f, 4, kWrapClampToEdge, false), 1, 2, 0.25f);
    expectSpan(texelSpan(0.375f, 4, kWrapRepeat, false), 1, 2, 0.0f);
    expectSpan(texelSpan(0.0f, 4, kWrapRepeat, false), 3, 0, 0.5f);
    expectSpan(texelSpan(0.0f, 4, kWrapClampToEdge, false), 0, 0, 0.5f);
    expectSpan(texelSpan(1.0f, 4, kWrapClampToEdge, false), 3, 3, 0.5f);
    expectSpan(texelSpan(1.25f, 4, kWrapMirroredRepeat, false), 2, 3, 0.5f);
    expectSpan(texelSpan(0.6f, 4, kWrapRepeat, true), 2, 2, 0.0f);
    expectSpan(texelSpan(1.0f, 4, kWrapClampToEdge, true), 3, 3, 0.0f);
}

TEST(Texture, weightsAreBilinear) {
    const vec4 w = bilinearWeights(0.25f, 0.125f);
    EXPECT_EQ(w, vec4(0.75f * 0.875f, 0.25f * 0.875f, 0.75f * 0.125f, 0.25f * 0.125f));
    EXPECT_EQ(blendTexels({0.125f, 0.25f, 0.5f, 2}, 8.0f, 16.0f, 32.0f, 64.0f), 1 + 4 + 16 + 128);
    EXPECT_EQ(blendTexels({0.125f, 0.25f, 0.5f, 2}, vec3(8), vec3(16), vec3(32), vec3(64)), vec3(1 + 4 + 16 + 128));
}

TEST(Texture, mipLevelsHalveDownToOneTexel) {
    EXPECT_EQ(mipSize(5, 0), 5);
    EXPECT_EQ(mipSize(5, 1), 2);
    EXPECT_EQ(mipSize(5, 2), 1);
    EXPECT_EQ(mipSize(5, 9), 1);
    EXPECT_EQ(mipLevels(1, 1), 1);
    EXPECT_EQ(mipLevels(5, 3), 3);
    EXPECT_EQ(mipLevels(1, 8), 4);
    EXPECT_EQ(mipLevels(8, 1), 4);
    EXPECT_EQ(mipOffset(8, 4, 1), 0);
    EXPECT_EQ(mipOffset(8, 4, 2), 4 * 2);
    EXPECT_EQ(mipOffset(8, 4, 3), 4 * 2 + 2 * 1);
    EXPECT_EQ(mipOffset(8, 4, 4), 4 * 2 + 2 * 1 + 1 * 1);
}

// A cone's circle of width spread * distance becomes an ellipse 1 / cosine as long on a tilted surface.
TEST(Texture, footprintsAreTheMeanOfTheEllipsesAxes) {
    EXPECT_FLOAT_EQ(coneFootprint(0.1f, 5, 1), 0.5f);
    for (const float cosine : {0.25f, -0.25f}) EXPECT_FLOAT_EQ(coneFootprint(0.1f, 5, cosine), 1.0f);
    EXPECT_FLOAT_EQ(coneFootprint(0.1f, 5, 0), 0.5f / std::sqrt(kLeastFootprintCosine));
}

TEST(Texture, areasInTheTexture) {
    EXPECT_FLOAT_EQ(uvArea({1, 1}, {3, 2}, {2, 5}), 7);
    EXPECT_FLOAT_EQ(uvArea({1, 1}, {2, 5}, {3, 2}), 7);
    EXPECT_EQ(uvArea({1, 1}, {2, 2}, {3, 3}), 0);
    EXPECT_FLOAT_EQ(texelsPerUvArea({2, 1, 9}, {1, 3, 9}, 4, 8), 5 * 32);
    EXPECT_FLOAT_EQ(texelsPerUvArea({1, 3, 9}, {2, 1, 9}, 4, 8), 5 * 32);
}

TEST(Texture, levelsDoubleTheTexel) {
    EXPECT_FLOAT_EQ(footprintLevel(4, 16, 4, 9), 3) << "8 texels wide";
    EXPECT_FLOAT_EQ(footprintLevel(1.5f, 16, 4, 9), std::log2(3.0f));
    EXPECT_EQ(footprintLevel(4, 16, 4, 3), 2);
    EXPECT_EQ(footprintLevel(0.5f, 16, 4, 9), 0);
    EXPECT_EQ(footprintLevel(0.1f, 16, 4, 9), 0);
    EXPECT_EQ(footprintLevel(1, 16, 0, 5), 4) << "no area";
}

}  // namespace
}  // namespace probegi::kernels
