#include "kernels/sampling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "reference/alias_table.h"
#include "reference/random.h"
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

TEST(AliasTable, choosesByWeight) {
    const std::array<double, 6> weights = {0, 1, 5, 0.5, 0, 3.5};
    const AliasTable table(weights);
    ASSERT_FALSE(table.empty());
    EXPECT_DOUBLE_EQ(table.totalWeight(), 10);
    Random random(9, 10);
    std::array<int, 6> counts{};
    for (int i = 0; i < 40000; ++i) ++counts[table.sample(random.nextDouble())];
    for (std::size_t i = 0; i < weights.size(); ++i)
        EXPECT_NEAR(counts[i], 4000 * weights[i], 4 * std::sqrt(4000 * weights[i]) + 0.5) << i;
}

TEST(AliasTable, withoutWeightIsEmpty) {
    EXPECT_TRUE(AliasTable().empty());
    EXPECT_TRUE(AliasTable(std::array<double, 3>{}).empty());
}

TEST(RunningStats, mergingEqualsAddingOneByOne) {
    Random random(11, 12);
    RunningStats whole, left, right;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 value(random.nextDouble(), 1e6 + random.nextDouble(), -random.nextDouble());
        whole.add(value);
        (i < 300 ? left : right).add(value);
    }
    left.merge(right);
    EXPECT_EQ(left.count, whole.count);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(left.mean[c], whole.mean[c], 1e-8);
        EXPECT_NEAR(left.standardError()[c], whole.standardError()[c], 1e-8);
        EXPECT_NEAR(whole.standardError()[c], std::sqrt(1.0 / 12 / 1000), 5e-4);
    }
}

}  // namespace
}  // namespace probegi
