#include "sdf/fit/fit_frames.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace probegi {
namespace {

/// `count` surfaces of each normal, forwards and backwards by turns.
std::vector<FitSurface> facing(std::initializer_list<std::pair<glm::vec3, int>> normals) {
    std::vector<FitSurface> surfaces;
    for (const auto& [normal, count] : normals)
        for (int i = 0; i < count; ++i) {
            FitSurface surface;
            surface.normal = glm::normalize(normal) * (i % 2 ? 1.0f : -1.0f);
            surfaces.push_back(surface);
        }
    return surfaces;
}

void expectNear(glm::vec3 a, glm::vec3 b) {
    EXPECT_LT(glm::length(a - b), 1e-3f) << a.x << " " << a.y << " " << a.z;
}

TEST(FitFrames, isTheWorldForUprightWalls) {
    const auto frames = findFrames(facing({{{0, 1, 0}, 500}, {{1, 0, 0}, 300}, {{0, 0, 1}, 200}}), 4);
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0], glm::mat3(1.0f));
}

TEST(FitFrames, turnsWithTheWalls) {
    const glm::quat turn = glm::angleAxis(0.5f, glm::normalize(glm::vec3(0.1f, 1, 0.2f)));
    const auto frames = findFrames(
        facing({{turn * glm::vec3(0, 1, 0), 500}, {turn * glm::vec3(1, 0, 0), 300}, {turn * glm::vec3(0, 0, 1), 200}}),
        4);
    ASSERT_EQ(frames.size(), 1u);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 unit(0.0f);
        unit[axis] = 1;
        expectNear(frames[0][axis], turn * unit);
    }
    EXPECT_GT(glm::determinant(frames[0]), 0.999f);
    EXPECT_TRUE(facesAlong(frames[0], turn * glm::vec3(0, 0, -1)));
    EXPECT_FALSE(facesAlong(frames[0], glm::vec3(0, 1, 0)));
}

TEST(FitFrames, addsOneForARoofsSlope) {
    const glm::vec3 slope(0, 0.9f, 0.3f);
    const auto frames = findFrames(
        facing({{{0, 1, 0}, 500}, {{1, 0, 0}, 300}, {{0, 0, 1}, 200}, {slope, 100}, {{0.5f, 0.7f, 0.5f}, 3}}), 4);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_TRUE(facesAlong(frames[1], glm::normalize(slope)));
    EXPECT_TRUE(facesAlong(frames[1], {1, 0, 0}));  // the ridge
    EXPECT_EQ(findFrames(facing({{{0, 1, 0}, 500}, {slope, 100}}), 1).size(), 1u);
}

TEST(FitFrames, isTheWorldWhereNothingTells) {
    EXPECT_EQ(findFrames({}, 4).size(), 1u);
    EXPECT_EQ(findFrames({}, 4)[0], glm::mat3(1.0f));
    // A floor alone leaves the turn about it open.
    const auto floor = findFrames(facing({{{0, 1, 0}, 10}}), 4);
    ASSERT_EQ(floor.size(), 1u);
    expectNear(glm::abs(floor[0][1]), {0, 1, 0});
    EXPECT_NEAR(glm::determinant(floor[0]), 1, 1e-4);
}

}  // namespace
}  // namespace probegi
