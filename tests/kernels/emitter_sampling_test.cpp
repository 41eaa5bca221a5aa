#include "kernels/light/emitter_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace probegi::kernels {
namespace {

TEST(EmitterChoice, hasOneSampleInEachOfEqualParts) {
    for (const uint looks : {1u, 3u, 4u, 16u})
        for (uint probe = 0; probe < 200; ++probe) {
            const uint seed = emitterSeed(7, probe);
            for (uint i = 0; i < looks; ++i) {
                const double choice = emitterChoice(seed, i, looks) / 4294967296.0;
                EXPECT_GE(choice, double(i) / looks - 1e-8);
                EXPECT_LT(choice, double(i + 1) / looks);
            }
        }
}

TEST(EmitterChoice, fillsItsPartEvenlyAndDiffersBetweenFrames) {
    std::vector<int> bins(64, 0);
    int same = 0;
    for (uint probe = 0; probe < 4096; ++probe) {
        for (uint i = 0; i < 4; ++i) ++bins[emitterChoice(emitterSeed(3, probe), i, 4) >> 26u];
        same += emitterChoice(emitterSeed(3, probe), 0, 4) == emitterChoice(emitterSeed(4, probe), 0, 4) ? 1 : 0;
    }
    // 256 expected, standard deviation 15.
    for (const int count : bins) EXPECT_NEAR(count, 256, 5 * 16);
    EXPECT_LT(same, 3);
}

// Uniform over the triangle: the means of both weights are a third, and of their squares a sixth.
TEST(EmitterBarycentric, isUniformOverTheTriangle) {
    glm::dvec2 first(0.0), second(0.0);
    constexpr int kProbes = 4000;
    for (uint probe = 0; probe < kProbes; ++probe) {
        const uint seed = emitterSeed(1, probe);
        for (uint i = 0; i < 4; ++i) {
            const vec2 b = emitterBarycentric(seed, i, emitterChoice(seed, i, 4), 0u, 0xffffffffu);
            EXPECT_GE(std::min(b.x, b.y), 0.0f);
            EXPECT_LE(b.x + b.y, 1.000001f);
            first += glm::dvec2(b) / (4.0 * kProbes);
            second += glm::dvec2(b) * glm::dvec2(b) / (4.0 * kProbes);
        }
    }
    for (int c = 0; c < 2; ++c) {
        EXPECT_NEAR(first[c], 1.0 / 3, 0.005);
        EXPECT_NEAR(second[c], 1.0 / 6, 0.005);
    }
}

TEST(EmitterAim, isWhereThePointIs) {
    const EmitterAim aim = aimAtEmitter({1, 2, 3}, {1, 5, 3}, {4, 0, 0}, {0, 0, 2}, {1, 0});
    EXPECT_NEAR(aim.distance, 5, 1e-6);
    EXPECT_NEAR(glm::length(aim.direction - vec3(0.8f, 0.6f, 0)), 0, 1e-6);
    EXPECT_NEAR(aim.cosine, 0.6, 1e-6);
    // Nothing is visible from the triangle's plane, from the point itself, or of a degenerate triangle.
    EXPECT_EQ(aimAtEmitter({-1, 5, 3}, {1, 5, 3}, {4, 0, 0}, {0, 0, 2}, {0, 0}).cosine, 0.0f);
    EXPECT_EQ(aimAtEmitter({1, 5, 3}, {1, 5, 3}, {4, 0, 0}, {0, 0, 2}, {0, 0}).cosine, 0.0f);
    EXPECT_EQ(aimAtEmitter({1, 2, 3}, {1, 5, 3}, {4, 0, 0}, {8, 0, 0}, {0, 0}).cosine, 0.0f);
}

// On average, rays and samples together contribute all of a point's light, whatever their shares: the density of rays
// times their share plus that of samples times theirs, per square metre of the emitter.
TEST(EmissionShare, bothWaysTogetherBringAllLight) {
    for (const int rays : {8, 64, 144, 4096})
        for (const int looks : {1, 4, 16})
            for (const float perArea : {1e-4f, 0.01f, 1.0f, 1e4f})
                for (const float distance : {0.01f, 1.0f, 30.0f})
                    for (const float cosine : {0.01f, 0.7f, 1.0f}) {
                        const EmitterAim aim{{0, 0, 1}, distance, cosine};
                        const double solidAngle = double(cosine) / (double(distance) * distance);  // per square metre
                        const double byRays =
                            double(rayEmissionShare(rays, looks, perArea, distance)) * solidAngle / double(kPi);
                        const double byLooks =
                            double(looks) * perArea * double(emitterLightFactor(rays, looks, perArea, aim));
                        EXPECT_NEAR((byRays + byLooks) * double(kPi) / solidAngle, 1.0, 1e-5);
                    }
}

TEST(EmissionShare, goesToTheDenserWay) {
    EXPECT_EQ(emissionShare(1, 1), 0.5f);
    EXPECT_NEAR(emissionShare(3, 1), 81.0f / 82.0f, 1e-6);
    EXPECT_EQ(emissionShare(0, 1), 0.0f);
    EXPECT_EQ(rayEmissionShare(144, 4, 0.0f, 2.0f), 1.0f);  // a material that is never sampled
    EXPECT_LT(rayEmissionShare(144, 4, 25.0f, 2.0f), 1e-4f);
    const EmitterAim never{{0, 0, 1}, 2.0f, 1.0f};
    EXPECT_EQ(emitterLightFactor(144, 4, 0.0f, never), 0.0f);
    // A probe on the emitter itself: no infinity.
    EXPECT_LT(emitterLightFactor(144, 4, 1.0f, {{0, 0, 1}, 1e-20f, 1.0f}), 1e-3f);
}

}  // namespace
}  // namespace probegi::kernels
