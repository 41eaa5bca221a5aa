#include "kernels/screen/glossy_ray.h"

#include <gtest/gtest.h>

#include <set>

namespace probegi::kernels {
namespace {

TEST(GlossyRay, roughSurfacesNeedNone) {
    EXPECT_EQ(glossyRayShare(0.0f), 1.0f);
    EXPECT_EQ(glossyRayShare(kGlossyRayRoughness), 1.0f);
    EXPECT_NEAR(glossyRayShare(0.5f * (kGlossyRayRoughness + kGlossyFieldRoughness)), 0.5f, 1e-5f);
    EXPECT_EQ(glossyRayShare(kGlossyFieldRoughness), 0.0f);
    EXPECT_EQ(glossyRayShare(1.0f), 0.0f);
}

TEST(GlossyRay, blocksCoverAllPixels) {
    EXPECT_EQ(glossyBlocks(1), 1);
    EXPECT_EQ(glossyBlocks(2), 1);
    EXPECT_EQ(glossyBlocks(3), 2);
    EXPECT_EQ(glossyBlocks(960), 480);
}

TEST(GlossyRay, allPixelsOfABlockAreTriedAndFourPlanesBeginWithAll) {
    std::set<int> first;
    for (int plane = 0; plane < 4; ++plane) {
        std::set<int> tried;
        for (int attempt = 0; attempt < 4; ++attempt) tried.insert(glossyCandidate(plane, attempt));
        EXPECT_EQ(tried, (std::set<int>{0, 1, 2, 3})) << plane;
        first.insert(glossyCandidate(plane, 0));
    }
    EXPECT_EQ(first.size(), 4u);
}

// Any 8 x 8 blocks hold 64 numbers, of which each eighth of a side has its share; and small groups nearly so.
TEST(GlossyRay, anyEightByEightBlocksAreEvenlySpread) {
    for (const int plane : {0, 1, 7})
        for (const ivec2 corner : {ivec2(0, 0), ivec2(3, 1), ivec2(50, 27)}) {
            int columns[8] = {}, rows[8] = {};
            std::set<float> values;
            for (int i = 0; i < 64; ++i) {
                const vec2 u = glossyPattern(corner.x + i % 8, corner.y + i / 8, plane);
                ASSERT_GE(std::min(u.x, u.y), 0.0f);
                ASSERT_LT(std::max(u.x, u.y), 1.0f);
                ++columns[int(8 * u.x)];
                ++rows[int(8 * u.y)];
                values.insert(u.x);
            }
            EXPECT_EQ(values.size(), 64u);
            for (int k = 0; k < 8; ++k) {
                EXPECT_NEAR(columns[k], 8, 2) << plane;
                EXPECT_NEAR(rows[k], 8, 2) << plane;
            }
        }
}

TEST(GlossyRay, reachIsTheShareOfTheWayBehindTheSurface) {
    EXPECT_EQ(glossyReach(0.0f, 2.0f), 0.0f);
    EXPECT_EQ(glossyReach(2.0f, 2.0f), 0.5f);
    EXPECT_EQ(glossyReach(3.0f, 0.0f), 1.0f);
    EXPECT_EQ(glossyReach(0.0f, 0.0f), 0.0f);
}

TEST(GlossyRay, aMirrorsRayIsTheMirrorImage) {
    const vec3 view = normalize(vec3(1, -2, 0.5f));
    EXPECT_EQ(glossyDirection({0, 1, 0}, {0, 1, 0}, view, 0.0f, {0.3f, 0.9f}), vec3(view.x, -view.y, view.z));
}

// Of all rays' half vectors, half are within the angle whose tangent is alpha, seen along the normal.
TEST(GlossyRay, theLobesWidthIsTheRoughnesss) {
    for (const float roughness : {0.2f, 0.5f, 0.7f}) {
        int inside = 0;
        for (int i = 0; i < 400; ++i) {
            const vec2 u((float(i % 20) + 0.5f) / 20, (float(i / 20) + 0.5f) / 20);
            const vec3 ray = glossyDirection({0, 1, 0}, {0, 1, 0}, {0, -1, 0}, roughness, u);
            const vec3 half = normalize(ray + vec3(0, 1, 0));
            inside += std::tan(std::acos(std::min(half.y, 1.0f))) < roughness * roughness ? 1 : 0;
        }
        EXPECT_NEAR(inside, 200, 21) << roughness;
    }
}

// A shading normal that leans over, and a grazing view.
TEST(GlossyRay, leavesTheSurface) {
    const vec3 leaning = normalize(vec3(1, 0.4f, 0)), view = normalize(vec3(0.2f, -0.1f, 0.9f));
    for (int i = 0; i < 64; ++i) {
        const vec2 u((float(i % 8) + 0.5f) / 8, (float(i / 8) + 0.5f) / 8);
        const vec3 ray = glossyDirection(leaning, {0, 1, 0}, normalize(view - leaning), 0.6f, u);
        EXPECT_GE(ray.y, 0.0f);
        EXPECT_NEAR(length(ray), 1.0f, 1e-5f);
    }
}

// The field keeps the cosine-weighted mean of radiance; in a furnace both are the same.
TEST(GlossyRay, irradianceOfAFurnaceIsItsRadiance) {
    EXPECT_NEAR(radianceOfIrradiance(vec3(2.5f * kPi)).x, 2.5f, 1e-6f);
}

TEST(GlossyRay, aWhiteMetalInAFurnaceIsAsBrightAsTheFurnace) {
    const Bsdf mirror = makeBsdf(vec3(1.0f), 1.0f, 0.05f, false);
    EXPECT_NEAR(hitRadiance(mirror, 0.7f, vec3(0), vec3(3 * kPi), vec3(3)).y, 3.0f, 3 * 0.013f);
    EXPECT_NEAR(glossyRadiance(mirror, 0.7f, vec3(3)).y, 3.0f, 3 * 0.013f);
    EXPECT_EQ(diffuseRadiance(mirror, 0.7f, vec3(3 * kPi)), vec3(0.0f));
}

TEST(GlossyRay, skyAndBackfacesAreTheirDirectLight) {
    const Bsdf none = makeBsdf(vec3(0.0f), 0.0f, 1.0f, false);
    EXPECT_EQ(hitRadiance(none, 0.5f, {1, 2, 3}, vec3(0), vec3(0)), vec3(1, 2, 3));
}

}  // namespace
}  // namespace probegi::kernels
