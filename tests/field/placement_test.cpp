#include <gtest/gtest.h>

#include <limits>

#include "field/layout.h"
#include "probegi/field.h"

namespace probegi {
namespace {

TEST(Placement, coversTheSceneWithACellOfMargin) {
    const Bounds bounds{{-19, -1, -12}, {18, 14, 11}};
    const auto grid = placeGrid(bounds);
    ASSERT_TRUE(grid);
    const glm::vec3 last = grid->origin + grid->spacing * glm::vec3(grid->counts - 1);
    for (int a = 0; a < 3; ++a) {
        EXPECT_LE(grid->origin[a], bounds.lower[a] - 0.999f * grid->spacing[a]);
        EXPECT_GE(last[a], bounds.upper[a] + 0.999f * grid->spacing[a]);
        EXPECT_FLOAT_EQ(grid->spacing[a], grid->spacing[0]);
    }
    EXPECT_LE(probeCount(*grid), 8192);
    EXPECT_GE(probeCount(*grid), 8192 / 2);
}

TEST(Placement, doesNotDependOnTheScale) {
    const glm::vec3 size(0.02f, 0.01f, 0.03f);
    const auto small = placeGrid({glm::vec3(0), size});
    const auto large = placeGrid({glm::vec3(0), size * 65536.0f});  // a power of two: the same rounding
    ASSERT_TRUE(small && large);
    EXPECT_EQ(small->counts, large->counts);
}

TEST(Placement, honoursCountsAndKeepsTheMargin) {
    const Bounds bounds{{0, 0, 0}, {10, 4, 10}};
    const auto grid = placeGrid(bounds, {.counts = {12, 6, 12}});
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->counts, glm::ivec3(12, 6, 12));
    EXPECT_LE(grid->origin.x, -grid->spacing.x);
    EXPECT_GE(grid->origin.x, -1.5f * grid->spacing.x);
    const auto tiny = placeGrid(bounds, {.counts = {2, 2, 2}});
    ASSERT_TRUE(tiny);
    EXPECT_LT(tiny->origin.x, 0.0f);
}

TEST(Placement, aFlatSceneStillGetsCells) {
    const auto grid = placeGrid({{0, 0, 0}, {10, 0, 10}});
    ASSERT_TRUE(grid);
    EXPECT_GE(grid->counts.y, 2);
    EXPECT_LT(grid->origin.y, 0.0f);
}

TEST(Placement, refusesWhatHasNoExtent) {
    EXPECT_FALSE(placeGrid({{1, 1, 1}, {1, 1, 1}}));
    EXPECT_FALSE(placeGrid({{0, 0, 0}, {std::numeric_limits<float>::infinity(), 1, 1}}));
    EXPECT_FALSE(placeGrid({{0, 0, 0}, {1, 1, 1}}, {.counts = {1, 5, 5}}));
    EXPECT_FALSE(placeGrid({{0, 0, 0}, {1, 1, 1}}, {.targetProbes = 1}));
    EXPECT_FALSE(placeGrid({{0, 0, 0}, {1, 1, 1}}, {.marginCells = -1}));
}

TEST(Grid, positionsFollowTheLinearIndex) {
    const GridDesc grid{{1, 2, 3}, {0.5f, 1, 2}, {3, 4, 5}};
    EXPECT_EQ(probePosition(grid, 0), glm::vec3(1, 2, 3));
    EXPECT_EQ(probePosition(grid, 2 + 3 * (3 + 4 * 4)), glm::vec3(2, 5, 11));
    EXPECT_EQ(probeCount(grid), 60);
}

TEST(Placement, aSceneTooSmallForProbesIsToldInItsOwnTerms) {
    const auto grid = placeGrid({{0, 0, 0}, {4e-6f, 4e-6f, 0}});
    ASSERT_FALSE(grid);
    EXPECT_NE(grid.error().message.find("the scene is only 4e-06 m large"), std::string::npos) << grid.error().message;
    EXPECT_EQ(grid.error().message.find("grid."), std::string::npos) << grid.error().message;
}

TEST(FieldDesc, gridsTooFarAwayAreRefused) {
    const auto at = [](glm::vec3 origin, float spacing) {
        FieldDesc d;
        d.grid = {origin, glm::vec3(spacing), glm::ivec3(8)};
        const auto ok = validateFieldDesc(d);
        return ok ? std::string("accepted") : ok.error().message;
    };
    EXPECT_EQ(at({1e4f, 0, -1e4f}, 0.5f), "accepted");
    EXPECT_NE(at({0, -5e5f, 0}, 0.5f).find("reaches 500000 m from the origin"), std::string::npos);
    EXPECT_EQ(at({0, -5e5f, 0}, 50.0f), "accepted") << "coarse coordinates do for coarse grids";
    EXPECT_NE(at({3e38f, 0, 0}, 1.0f).find("from the origin"), std::string::npos);
}

// Every member of FieldDesc that is out of range is refused by name.
TEST(FieldDesc, refusalsNameTheMember) {
    const auto message = [](auto&& edit) -> std::string {
        FieldDesc d;
        edit(d);
        const auto ok = validateFieldDesc(d);
        return ok ? "accepted" : ok.error().message;
    };
    EXPECT_EQ(message([](FieldDesc&) {}), "accepted");
    EXPECT_NE(message([](FieldDesc& d) { d.raysPerProbe = 7; }).find("raysPerProbe is 7"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.irradianceTexels = 7; }).find("irradianceTexels"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.visibilityTexels = 66; }).find("visibilityTexels"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.hysteresis = 1.0f; }).find("hysteresis"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.hysteresis = std::nanf(""); }).find("hysteresis"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.grid.counts.y = 1; }).find("grid.counts"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) {
                  d.grid.counts = {1024, 1024, 1024};
              }).find("number of probes"),
              std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.grid.spacing.z = 0; }).find("grid.spacing"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.grid.origin.x = std::nanf(""); }).find("grid.origin"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.visibilityExponent = 0; }).find("visibilityExponent"), std::string::npos);
    EXPECT_NE(message([](FieldDesc& d) { d.selfShadowBias = -1; }).find("selfShadowBias"), std::string::npos);
}

}  // namespace
}  // namespace probegi
