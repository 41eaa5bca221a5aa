#include "sdf/fit/fit_voxels.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace probegi {
namespace {

Context context() {
    return Context::create({.threads = 2}).value();
}

/// Rays from the plane x = 0 along +X to a plate of 2 x 2 m at x = 4, in a grid of 0.05 m.
std::vector<FitRay> raysAtPlate() {
    std::vector<FitRay> rays;
    for (int y = 0; y < 40; ++y)
        for (int z = 0; z < 40; ++z) {
            FitRay ray;
            ray.origin = {0, 0.05f * (float(y) + 0.5f), 0.05f * (float(z) + 0.5f)};
            ray.direction = {1, 0, 0};
            ray.distance = 4;
            rays.push_back(ray);
        }
    return rays;
}

void addAll(FitVoxels& voxels, const std::vector<FitRay>& rays) {
    for (const FitRay& ray : rays) voxels.add(ray, ray.distance, ray.distance, 1);
    voxels.sum();
}

TEST(FitVoxels, growsABoxOverWhereRaysEndAndStopsNone) {
    const auto rays = raysAtPlate();
    FitVoxels voxels(rays, 64, 0);
    addAll(voxels, rays);
    std::uint32_t state = 1;
    const auto found = voxels.bestBox(context(), 16, state);
    EXPECT_NEAR(found.worth, 1600, 1e-2);
    EXPECT_LE(found.box.lower.y, 0.03f);
    EXPECT_GE(found.box.upper.y, 1.97f);
    EXPECT_GE(found.box.lower.x, 4 - voxels.cell() - 1e-4f);  // a cube in front of the plate at most
    EXPECT_LE(found.box.lower.x, 4.001f);
    EXPECT_GT(found.box.upper.x, 4);
}

TEST(FitVoxels, hasNothingLeftOnceAllIsCovered) {
    const auto rays = raysAtPlate();
    FitVoxels voxels(rays, 32, 0);
    addAll(voxels, rays);
    std::uint32_t state = 1;
    const FitBox all{{3, -1, -1}, {5, 3, 3}};
    EXPECT_TRUE(voxels.cover(all, glm::mat3(1.0f)));
    voxels.sum();
    EXPECT_EQ(voxels.bestBox(context(), 16, state).worth, 0);
    EXPECT_FALSE(voxels.cover(all, glm::mat3(1.0f)));
}

TEST(FitVoxels, coversByABoxOfAnotherFrame) {
    const auto rays = raysAtPlate();
    FitVoxels voxels(rays, 32, 0);
    addAll(voxels, rays);
    // Axes go round: x of the box is the grid's z.
    const glm::mat3 toBox(glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0));
    EXPECT_TRUE(voxels.cover({toBox * glm::vec3(3, -1, -1), toBox * glm::vec3(5, 1, 3)}, toBox));
    voxels.sum();
    std::uint32_t state = 1;
    const auto found = voxels.bestBox(context(), 16, state);
    EXPECT_NEAR(found.worth, 800, 30);  // half of the plate is left
    EXPECT_GE(found.box.upper.y, 1.97f);
}

TEST(FitVoxels, doesNotBlockWhatPasses) {
    // Ten rays end in the middle of a beam of a thousand that pass.
    std::vector<FitRay> rays(1010);
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays[i] = {{0, 0.001f * float(i % 10), 0}, i < 10 ? 2.0f : 4.0f, {1, 0, 0}, 1};
    FitVoxels voxels(rays, 32, 0);
    for (std::size_t i = 0; i < 10; ++i) voxels.add(rays[i], 2, 2, 1);
    for (std::size_t i = 10; i < rays.size(); ++i) voxels.add(rays[i], 4, 4, 0);
    voxels.sum();
    std::uint32_t state = 1;
    EXPECT_EQ(voxels.bestBox(context(), 16, state).worth, 0);
}

TEST(FitVoxels, doesWithoutRays) {
    FitVoxels voxels({}, 32, 0);
    voxels.sum();
    std::uint32_t state = 1;
    EXPECT_EQ(voxels.bestBox(context(), 16, state).worth, 0);
}

}  // namespace
}  // namespace probegi
