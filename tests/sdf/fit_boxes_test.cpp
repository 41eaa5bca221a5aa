#include "sdf/fit/fit_boxes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace probegi {
namespace {

const glm::mat3 kWorld(1.0f);

/// Rays from a square at x = 0 along +X that end at x = `wall` where |y|, |z| < 1, and go on to the sky elsewhere.
std::vector<FitRay> raysAtWall(float wall) {
    std::vector<FitRay> rays;
    for (int y = -15; y <= 15; ++y)
        for (int z = -15; z <= 15; ++z) {
            FitRay ray;
            ray.origin = {0, 0.1f * float(y) + 0.03f, 0.1f * float(z) + 0.04f};
            ray.direction = {1, 0, 0};
            const bool hits = std::abs(ray.origin.y) < 1 && std::abs(ray.origin.z) < 1;
            ray.distance = hits ? wall : kFitSky;
            rays.push_back(ray);
        }
    return rays;
}

FitBoxes boxesFor(std::span<const FitRay> rays, std::span<const float> ends = {}) {
    return FitBoxes(Context::create({.threads = 1}).value(), rays, ends, std::span(&kWorld, 1), FitCost{});
}

TEST(FitCost, isNothingForTheRightDistanceAndGrowsWithTheError) {
    const FitCost cost{.usual = 0.1f, .leak = 10, .sky = 3, .grazing = 0.25f};
    EXPECT_EQ(cost(2, 1, 2), 0);
    EXPECT_NEAR(cost(2, 1, 2.1f), 0.5f, 1e-4f);     // log2(2) / 2
    EXPECT_NEAR(cost(2, 1, 1.7f), 1, 1e-4f);        // log2(4) / 2
    EXPECT_NEAR(cost(2, 0.5f, 2.2f), 0.5f, 1e-4f);  // across the surface
    EXPECT_NEAR(cost(2, 0, 2.4f), 0.5f, 1e-4f);
    EXPECT_EQ(cost(2, 1, kFitSky), 10);
    EXPECT_EQ(cost(kFitSky, 1, 5), 3);
    EXPECT_EQ(cost(kFitSky, 1, kFitSky), 0);
    EXPECT_EQ(cost(2, 1, 0), 3);
}

TEST(FitBoxes, knowsWhereRaysEnd) {
    const auto rays = raysAtWall(5);
    FitBoxes fit = boxesFor(rays);
    fit.set({{{4, -1, -1}, {6, 1, 1}}, {{3, -0.2f, -0.2f}, {3.5f, 0.2f, 0.2f}}}, 0.1f);
    const std::size_t middle = 15 * 31 + 15, beside = 20 * 31 + 15, outside = 0;
    EXPECT_EQ(fit.distance(middle), 3);
    EXPECT_EQ(fit.box(middle), 1);
    EXPECT_EQ(fit.distance(beside), 4);
    EXPECT_EQ(fit.box(beside), 0);
    EXPECT_EQ(fit.distance(outside), kFitSky);
    EXPECT_EQ(fit.box(outside), -1);
    fit.remove(1);
    EXPECT_EQ(fit.distance(middle), 4);
    EXPECT_EQ(fit.box(middle), 0);
    fit.append({{-1, -1, -1}, {1, 1, 1}}, 0.1f);
    EXPECT_EQ(fit.distance(middle), 0);  // it begins inside
    fit.replace(1, {{2, -1, -1}, {3, 1, 1}}, 0.1f);
    EXPECT_EQ(fit.distance(middle), 2);
}

TEST(FitBoxes, movesFacesToTheSurfaceAndToItsEdges) {
    const auto rays = raysAtWall(5);
    FitBoxes fit = boxesFor(rays);
    fit.set({{{4.6f, -1.3f, -0.8f}, {5.2f, 0.7f, 1.2f}}}, 0.1f);
    const double before = fit.cost();
    double after = before;
    for (int i = 0; i < 24; ++i) {
        const double next = fit.sweep();
        EXPECT_LE(next, after + 1e-12);
        after = next;
    }
    const FitBox& box = fit.boxes()[0];
    EXPECT_NEAR(box.lower.x, 5, 0.005f);
    EXPECT_GT(box.upper.x, 5);
    // Between the last ray that hits and the first that does not.
    EXPECT_NEAR(box.lower.y, -1.0f, 0.08f);
    EXPECT_NEAR(box.upper.y, 1.0f, 0.08f);
    EXPECT_LT(after, 0.05);
    EXPECT_LT(after, 0.1 * before);
}

// One whose faces have met could not be moved any more.
TEST(FitBoxes, pushesAThinBoxAlong) {
    const auto rays = raysAtWall(5);
    FitBoxes fit = boxesFor(rays);
    fit.set({{{4.5f, -1, -1}, {4.501f, 1, 1}}}, 0.1f);
    for (int i = 0; i < 16; ++i) fit.sweep();
    EXPECT_NEAR(fit.boxes()[0].lower.x, 5, 0.005f);
}

TEST(FitBoxes, tellsWhatABoxIsWorth) {
    const auto rays = raysAtWall(5);
    FitBoxes fit = boxesFor(rays);
    const FitBox wall{{5, -1, -1}, {6, 1, 1}};
    fit.set({}, 0.1f);
    const double saved = fit.saves(wall), before = fit.cost();
    fit.append(wall, 0.1f);
    EXPECT_NEAR(before - fit.cost(), saved, 1e-9);
    EXPECT_NEAR(fit.worth()[0], saved, 1e-9);
    fit.append({{5.2f, -1, -1}, {6, 1, 1}}, 0.1f);  // hidden
    EXPECT_EQ(fit.worth()[1], 0);
}

TEST(FitBoxes, leavesToOthersWhatIsThereAlready) {
    const auto rays = raysAtWall(5);
    std::vector<float> ends;
    for (const FitRay& ray : rays) ends.push_back(ray.distance);
    FitBoxes fit = boxesFor(rays, ends);
    fit.set({}, 0.1f);
    EXPECT_EQ(fit.cost(), 0);
    fit.append({{5.5f, -1, -1}, {6, 1, 1}}, 0.1f);
    EXPECT_EQ(fit.worth()[0], 0);
}

TEST(FitBoxes, doesWithoutRays) {
    FitBoxes fit = boxesFor({});
    fit.set({{{0, 0, 0}, {1, 1, 1}}}, 0.1f);
    EXPECT_EQ(fit.sweep(), 0);
    EXPECT_EQ(fit.saves(fit.boxes()[0]), 0);
}

}  // namespace
}  // namespace probegi
