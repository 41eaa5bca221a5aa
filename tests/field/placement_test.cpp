#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "field/layout.h"
#include "probegi/field.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

Result<void> validate(const FieldSetup& setup) {
    return validateFieldDesc(setup).and_then([&] { return validateFieldSettings(setup); });
}

TEST(Placement, coversTheSceneWithACellOfMargin) {
    const Bounds bounds{{-19, -1, -12}, {18, 14, 11}};
    const auto grid = placeVolume(bounds);
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

// Where a window must go to follow a point.
TEST(Placement, cellsToCentreBringThePointToTheMiddle) {
    VolumeDesc volume{.origin = {3, -2, 7}, .spacing = {0.5f, 2, 1}, .counts = {8, 5, 6}};
    for (const float angle : {0.0f, 0.8f}) {
        volume.orientation = glm::angleAxis(angle, glm::vec3(0, 0.6f, 0.8f));
        for (const glm::vec3 point : {glm::vec3(0, 0, 0), glm::vec3(-81.3f, 40, 3), glm::vec3(1e3f, 0.2f, -5e2f)}) {
            const glm::ivec3 cells = cellsToCentre(volume, point);
            VolumeDesc moved = volume;
            moved.origin += volume.orientation * (glm::vec3(cells) * volume.spacing);
            const glm::vec3 middle = 0.5f * glm::vec3(volume.counts - 1) * volume.spacing;
            const glm::vec3 off = glm::conjugate(volume.orientation) * (point - moved.origin) - middle;
            for (int a = 0; a < 3; ++a) EXPECT_LE(std::abs(off[a]), 0.501f * volume.spacing[a]) << a;
            EXPECT_EQ(cellsToCentre(moved, point), glm::ivec3(0));
        }
    }
    // On the seam of two cells: once, and not back.
    volume = {.counts = {4, 4, 4}};
    EXPECT_EQ(cellsToCentre(volume, glm::vec3(2)), glm::ivec3(1));
    volume.origin = glm::vec3(1);
    EXPECT_EQ(cellsToCentre(volume, glm::vec3(2)), glm::ivec3(0));
    EXPECT_EQ(cellsToCentre(volume, {1e30f, -1e30f, 0}).x, 1'000'000'000);
    EXPECT_EQ(cellsToCentre(volume, {1e30f, -1e30f, 0}).y, -1'000'000'000);
    EXPECT_EQ(cellsToCentre(volume, glm::vec3(std::numeric_limits<float>::quiet_NaN())), glm::ivec3(0));
}

TEST(Placement, doesNotDependOnTheScale) {
    const glm::vec3 size(0.02f, 0.01f, 0.03f);
    const auto small = placeVolume({glm::vec3(0), size});
    const auto large = placeVolume({glm::vec3(0), size * 65536.0f});  // a power of two: the same rounding
    ASSERT_TRUE(small && large);
    EXPECT_EQ(small->counts, large->counts);
}

TEST(Placement, honoursCountsAndKeepsTheMargin) {
    const Bounds bounds{{0, 0, 0}, {10, 4, 10}};
    const auto grid = placeVolume(bounds, {.counts = {12, 6, 12}});
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->counts, glm::ivec3(12, 6, 12));
    EXPECT_LE(grid->origin.x, -grid->spacing.x);
    EXPECT_GE(grid->origin.x, -1.5f * grid->spacing.x);
    const auto tiny = placeVolume(bounds, {.counts = {2, 2, 2}});
    ASSERT_TRUE(tiny);
    EXPECT_LT(tiny->origin.x, 0.0f);
}

TEST(Placement, aFlatSceneStillGetsCells) {
    const auto grid = placeVolume({{0, 0, 0}, {10, 0, 10}});
    ASSERT_TRUE(grid);
    EXPECT_GE(grid->counts.y, 2);
    EXPECT_LT(grid->origin.y, 0.0f);
}

TEST(Placement, refusesWhatHasNoExtent) {
    EXPECT_FALSE(placeVolume({{1, 1, 1}, {1, 1, 1}}));
    EXPECT_FALSE(placeVolume({{0, 0, 0}, {std::numeric_limits<float>::infinity(), 1, 1}}));
    EXPECT_FALSE(placeVolume({{0, 0, 0}, {1, 1, 1}}, {.counts = {1, 5, 5}}));
    EXPECT_FALSE(placeVolume({{0, 0, 0}, {1, 1, 1}}, {.targetProbes = 1}));
    EXPECT_FALSE(placeVolume({{0, 0, 0}, {1, 1, 1}}, {.marginCells = -1}));
}

// A margin of one and a quarter cells on each side; with too few probes, twice the scene's size.
TEST(Placement, marginsAreExact) {
    const Bounds bounds{{-5, 0, 0}, {5, 4, 20}};
    const auto grid = placeVolume(bounds, {.counts = {12, 6, 12}, .marginCells = 1});
    ASSERT_TRUE(grid);
    EXPECT_FLOAT_EQ(grid->spacing.x, 10 / 8.5f);
    EXPECT_FLOAT_EQ(grid->spacing.y, 4 / 2.5f);
    EXPECT_FLOAT_EQ(grid->spacing.z, 20 / 8.5f);
    EXPECT_FLOAT_EQ(grid->origin.x, -5.5f * 10 / 8.5f);
    EXPECT_FLOAT_EQ(grid->origin.y, 2 - 2.5f * 4 / 2.5f);
    EXPECT_FLOAT_EQ(grid->origin.z, 10 - 5.5f * 20 / 8.5f);
    const auto tiny = placeVolume(bounds, {.counts = {2, 2, 2}, .marginCells = 1});
    ASSERT_TRUE(tiny);
    EXPECT_FLOAT_EQ(tiny->spacing.x, 20);
    const auto flat = placeVolume({{0, 0, 0}, {10, 0, 10}}, {.counts = {4, 4, 4}, .marginCells = 0});
    ASSERT_TRUE(flat);
    EXPECT_FLOAT_EQ(flat->spacing.y, 0.01f / 2.5f);
}

// The densest cubic grid within the target: with cells 1 % smaller, there would be too many probes.
TEST(Placement, usesTheTarget) {
    const glm::vec3 size(7, 3, 11);
    const auto probesAt = [&](float spacing, float margin) {
        double probes = 1;
        for (int axis = 0; axis < 3; ++axis) probes *= std::ceil(size[axis] / spacing + 2 * (margin + 0.25f)) + 1;
        return probes;
    };
    for (const int target : {1000, 5000, 30000})
        for (const float margin : {0.0f, 1.0f, 2.5f}) {
            const auto grid = placeVolume({glm::vec3(0), size}, {.targetProbes = target, .marginCells = margin});
            ASSERT_TRUE(grid);
            EXPECT_LE(probeCount(*grid), target);
            EXPECT_EQ(probeCount(*grid), probesAt(grid->spacing.x, margin));
            EXPECT_GT(probesAt(0.99f * grid->spacing.x, margin), target);
        }
}

TEST(Placement, limitsAreInclusive) {
    const Bounds box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(placeVolume(box, {.marginCells = 0}));
    EXPECT_TRUE(placeVolume(box, {.targetProbes = 1 << 24, .marginCells = 100}));
    EXPECT_FALSE(placeVolume(box, {.marginCells = 100.5f}));
    EXPECT_FALSE(placeVolume(box, {.marginCells = std::nanf("")}));
    EXPECT_TRUE(placeVolume(box, {.targetProbes = 8, .marginCells = 0}));
    EXPECT_FALSE(placeVolume(box, {.targetProbes = 7}));
    EXPECT_FALSE(placeVolume(box, {.targetProbes = (1 << 24) + 1}));
    for (int axis = 0; axis < 3; ++axis)
        for (const auto& [count, taken] : {std::pair{2, true}, {1024, true}, {1, false}, {1025, false}}) {
            PlacementDesc desc{.counts = {3, 3, 3}};
            desc.counts[axis] = count;
            EXPECT_EQ(bool(placeVolume(box, desc)), taken) << axis << ' ' << count;
        }
    // The least spacing is a micrometre.
    EXPECT_TRUE(placeVolume({{0, 0, 0}, glm::vec3(1.01e-6f * 8.5f)}, {.counts = glm::ivec3(12), .marginCells = 1}));
    EXPECT_FALSE(placeVolume({{0, 0, 0}, glm::vec3(0.99e-6f * 8.5f)}, {.counts = glm::ivec3(12), .marginCells = 1}));
}

TEST(Grid, positionsFollowTheLinearIndex) {
    const VolumeDesc grid{{1, 2, 3}, {0.5f, 1, 2}, {3, 4, 5}};
    EXPECT_EQ(probePosition(grid, 0), glm::vec3(1, 2, 3));
    EXPECT_EQ(probePosition(grid, 2 + 3 * (3 + 4 * 4)), glm::vec3(2, 5, 11));
    EXPECT_EQ(probeCount(grid), 60);
}

TEST(Placement, aSceneTooSmallForProbesIsReportedAsSuch) {
    const auto grid = placeVolume({{0, 0, 0}, {4e-6f, 4e-6f, 0}});
    ASSERT_FALSE(grid);
    EXPECT_NE(grid.error().message.find("the scene is only 4e-06 m large"), std::string::npos) << grid.error().message;
    EXPECT_EQ(grid.error().message.find("grid."), std::string::npos) << grid.error().message;
}

TEST(FieldDesc, gridsTooFarAwayAreRefused) {
    const auto at = [](glm::vec3 origin, float spacing) {
        FieldSetup d;
        d.volumes[0] = {origin, glm::vec3(spacing), glm::ivec3(8)};
        const auto ok = validate(d);
        return ok ? std::string("accepted") : ok.error().message;
    };
    EXPECT_EQ(at({1e4f, 0, -1e4f}, 0.5f), "accepted");
    EXPECT_NE(at({0, -5e5f, 0}, 0.5f).find("reaches 500000 m from the origin"), std::string::npos);
    EXPECT_EQ(at({0, -5e5f, 0}, 50.0f), "accepted") << "coarse coordinates do for coarse grids";
    EXPECT_NE(at({3e38f, 0, 0}, 1.0f).find("from the origin"), std::string::npos);
}

// Errors name the member of FieldDesc that is out of range.
TEST(FieldDesc, refusalsNameTheMember) {
    const auto message = [](auto&& edit) -> std::string {
        FieldSetup d;
        edit(d);
        const auto ok = validate(d);
        return ok ? "accepted" : ok.error().message;
    };
    EXPECT_EQ(message([](FieldSetup&) {}), "accepted");
    EXPECT_NE(message([](FieldSetup& d) { d.raysPerProbe = 7; }).find("raysPerProbe is 7"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.irradianceTexels = 7; }).find("irradianceTexels"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.visibilityTexels = 66; }).find("visibilityTexels"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.hysteresis = 1.0f; }).find("hysteresis"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.hysteresis = std::nanf(""); }).find("hysteresis"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.volumes[0].counts.y = 1; }).find("volumes[0].counts"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) {
                  d.volumes[0].counts = {1024, 1024, 1024};
              }).find("number of probes"),
              std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.volumes[0].spacing.z = 0; }).find("volumes[0].spacing"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.volumes[0].origin.x = std::nanf(""); }).find("volumes[0].origin"),
              std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.visibilityExponent = 0; }).find("visibilityExponent"), std::string::npos);
    EXPECT_NE(message([](FieldSetup& d) { d.selfShadowBias = -1; }).find("selfShadowBias"), std::string::npos);
}

}  // namespace
}  // namespace probegi
