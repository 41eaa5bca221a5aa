#include "kernels/sampling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "reference/random_stream.h"
#include "reference/running_stats.h"

namespace probegi {
namespace {

using kernels::vec2;
using kernels::vec3;

TEST(OrthonormalBasis, isRightHandedAndUnitForEveryNormal) {
    Random random(1, 1);
    std::vector<vec3> normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
    normals.push_back(glm::normalize(vec3(1e-4f, 0, -1)));
    for (int i = 0; i < 200; ++i) normals.push_back(kernels::sampleSphere(random.nextPair()));
    for (const vec3& n : normals) {
        const kernels::mat3 frame = kernels::orthonormalBasis(n);
        EXPECT_EQ(frame[2], n);
        EXPECT_NEAR(glm::length(frame[0]), 1, 1e-5);
        EXPECT_NEAR(glm::dot(frame[0], frame[1]), 0, 1e-5);
        EXPECT_NEAR(glm::length(glm::cross(frame[0], frame[1]) - n), 0, 1e-5);
        const vec3 d = glm::normalize(vec3(0.3f, -0.5f, 0.8f));
        EXPECT_NEAR(glm::length(kernels::toLocal(frame, kernels::toWorld(frame, d)) - d), 0, 1e-5);
    }
}

/// First and second moments of a distribution of directions, from samples.
struct Moments {
    explicit Moments(vec3 (*sample)(vec2)) {
        Random random(3, 4);
        for (int i = 0; i < 20000; ++i) {
            const vec3 d = sample(random.nextPair());
            EXPECT_NEAR(glm::length(d), 1, 1e-5);
            first.add(d);
            second.add(d * d);
        }
    }
    RunningStats first, second;
};

void expectMean(const RunningStats& stats, glm::dvec3 truth) {
    const glm::dvec3 error = stats.standardError();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(stats.mean[c], truth[c], 3.5 * error[c]) << c;
}

TEST(CosineHemisphere, moments) {
    const Moments m(kernels::sampleCosineHemisphere);
    expectMean(m.first, {0, 0, 2.0 / 3});
    expectMean(m.second, {0.25, 0.25, 0.5});
}

TEST(Sphere, moments) {
    const Moments m(kernels::sampleSphere);
    expectMean(m.first, {0, 0, 0});
    expectMean(m.second, glm::dvec3(1.0 / 3));
}

TEST(Disk, isUniformAndReachesItsEdge) {
    EXPECT_EQ(kernels::sampleDisk(vec2(0.5f)), vec2(0.0f));
    EXPECT_NEAR(glm::length(kernels::sampleDisk(vec2(0.0f, 0.3f))), 1, 1e-6);
    Random random(5, 6);
    std::array<int, 8> rings{};
    for (int i = 0; i < 16000; ++i) {
        const vec2 d = kernels::sampleDisk(random.nextPair());
        ++rings[std::size_t(std::min(7.0f, 8 * glm::dot(d, d)))];  // r^2 is uniform
    }
    for (const int count : rings) EXPECT_NEAR(count, 2000, 4 * std::sqrt(2000.0));
}

TEST(Triangle, centroid) {
    Random random(7, 8);
    RunningStats stats;
    for (int i = 0; i < 20000; ++i) {
        const vec2 b = kernels::sampleTriangle(random.nextPair());
        EXPECT_LE(b.x + b.y, 1.0f);
        stats.add({b.x, b.y, 0});
    }
    expectMean(stats, {1.0 / 3, 1.0 / 3, 0});
}

TEST(PowerHeuristic, weightsOfBothStrategiesAddUpToOne) {
    for (const float a : {1e-6f, 0.3f, 7.0f, 1e8f})
        for (const float b : {0.0f, 1e-3f, 2.0f, 1e6f})
            EXPECT_NEAR(kernels::powerHeuristic(a, b) + kernels::powerHeuristic(b, a), 1, 1e-6);
    EXPECT_EQ(kernels::powerHeuristic(0, 0), 0);
}

// The densities of Malley's and Archimedes' maps, which the moments above assume.
TEST(CosineHemisphere, density) {
    EXPECT_FLOAT_EQ(kernels::pdfCosineHemisphere(0.5f), 0.5f / kernels::kPi);
    EXPECT_EQ(kernels::pdfCosineHemisphere(-0.5f), 0.0f);
}

// Corners and centres of the square's four triangles.
TEST(Disk, mapsTheSquaresPartsToSectors) {
    const auto expectAt = [](vec2 u, float radius, float turn) {
        const vec2 d = kernels::sampleDisk(u);
        EXPECT_NEAR(d.x, radius * std::cos(turn * kernels::kPi), 1e-6) << u.x << ' ' << u.y;
        EXPECT_NEAR(d.y, radius * std::sin(turn * kernels::kPi), 1e-6) << u.x << ' ' << u.y;
    };
    expectAt({1.0f, 0.5f}, 1, 0);
    expectAt({0.5f, 1.0f}, 1, 0.5f);
    expectAt({0.0f, 0.5f}, 1, 1);
    expectAt({0.5f, 0.0f}, 1, 1.5f);
    expectAt({1.0f, 0.75f}, 1, 0.125f);
    expectAt({0.75f, 1.0f}, 1, 0.375f);
    expectAt({0.75f, 0.5f}, 0.5f, 0);
}

TEST(Sphere, runsFromPoleToPoleAndAround) {
    EXPECT_NEAR(glm::length(kernels::sampleSphere({0.0f, 0.3f}) - vec3(0, 0, 1)), 0, 1e-6);
    EXPECT_NEAR(glm::length(kernels::sampleSphere({1.0f, 0.3f}) - vec3(0, 0, -1)), 0, 1e-6);
    EXPECT_NEAR(glm::length(kernels::sampleSphere({0.5f, 0.25f}) - vec3(0, 1, 0)), 0, 1e-6);
}

TEST(Triangle, isTheSquareFoldedAlongItsDiagonal) {
    EXPECT_EQ(kernels::sampleTriangle({0.25f, 0.5f}), vec2(0.25f, 0.5f));
    EXPECT_EQ(kernels::sampleTriangle({0.75f, 0.5f}), vec2(0.25f, 0.5f));
    EXPECT_EQ(kernels::sampleTriangle({0.25f, 0.75f}), vec2(0.25f, 0.75f));
}

TEST(PowerHeuristic, hasExponentTwo) {
    EXPECT_FLOAT_EQ(kernels::powerHeuristic(3, 1), 0.9f);
    EXPECT_FLOAT_EQ(kernels::powerHeuristic(1, 2), 0.2f);
}

}  // namespace
}  // namespace probegi
