// Cascades, windows that follow a camera, and what volumes cover, without probes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "field/volume_access.h"
#include "probegi/field.h"

namespace probegi {
namespace {

using testing::HasSubstr;

Field fieldOf(std::vector<VolumeDesc> volumes) {
    FieldDesc desc;
    desc.volumes = std::move(volumes);
    return Field::create(Context::create({.threads = 1}).value(), desc).value();
}

TEST(Cascades, areNestedAroundTheirCentre) {
    const auto volumes = makeCascades({.centre = {1, 2, 3}, .spacing = {0.5f, 0.25f, 0.5f}, .levels = 3, .factor = 3});
    ASSERT_TRUE(volumes) << volumes.error().message;
    ASSERT_EQ(volumes->size(), 3u);
    glm::vec3 spacing(0.5f, 0.25f, 0.5f);
    for (const VolumeDesc& v : *volumes) {
        EXPECT_EQ(v.counts, glm::ivec3(24, 12, 24));
        EXPECT_TRUE(v.tracksCamera);
        EXPECT_EQ(v.spacing, spacing);
        const glm::vec3 middle = v.origin + 0.5f * spacing * glm::vec3(v.counts - 1);
        EXPECT_LT(glm::distance(middle, glm::vec3(1, 2, 3)), 1e-5f);
        spacing *= 3.0f;
    }
    EXPECT_TRUE(Field::create(Context::create({.threads = 1}).value(), {.volumes = *volumes}));
}

TEST(Cascades, refuseWhatCannotBe) {
    const auto refused = [](const CascadeDesc& desc, const char* words) {
        const auto volumes = makeCascades(desc);
        ASSERT_FALSE(volumes) << words;
        EXPECT_EQ(volumes.error().code, ErrorCode::invalidArgument);
        EXPECT_THAT(volumes.error().message, HasSubstr(words));
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    refused({.levels = 0}, "levels is 0");
    refused({.levels = 33}, "levels is 33");
    refused({.factor = 1}, "factor is 1");
    refused({.factor = nan}, "factor");
    refused({.factor = 17}, "factor is 17");
    refused({.counts = {24, 4, 24}}, "counts is 4");
    refused({.counts = {24, 12, 1025}}, "counts is 1025");
    refused({.centre = {0, nan, 0}}, "centre");
    refused({.spacing = {0, 1, 1}}, "spacing");
    refused({.spacing = glm::vec3(nan)}, "spacing");
    refused({.counts = {400, 200, 400}}, "probes in all volumes");
    refused({.centre = {1e8f, 0, 0}}, "too coarse");
}

TEST(Volumes, byDensityThenByTheList) {
    FieldDesc desc;
    desc.volumes.assign(5, VolumeDesc{});
    desc.volumes[1].spacing = {2, 0.1f, 1};
    desc.volumes[3].spacing = glm::vec3(4);
    desc.volumes[4].spacing = {0.2f, 1, 1};  // as dense as the second
    desc.volumes[4].spacing.x = 2 * 0.1f;
    EXPECT_EQ(volumesByDensity(desc), (std::vector<int>{1, 4, 0, 2, 3}));
}

TEST(Volumes, trackOnlyACameraThatIsKnown) {
    FieldDesc desc;
    desc.volumes.assign(3, VolumeDesc{});
    desc.volumes[2].tracksCamera = true;
    FieldSettings settings;
    EXPECT_EQ(volumeOrder(desc, settings, {}).tracking, 0u);
    settings.camera = glm::vec3(1);
    EXPECT_EQ(volumeOrder(desc, settings, {}).tracking, 4u);
}

TEST(Volumes, coverageIsTheMostThatAnyHas) {
    Field field = fieldOf({{.spacing = glm::vec3(1), .counts = glm::ivec3(5)},
                           {.origin = {10, 0, 0},
                            .spacing = glm::vec3(2),
                            .counts = glm::ivec3(3),
                            .orientation = glm::angleAxis(1.5707964f, glm::vec3(0, 1, 0))}});
    const auto covered = [&](glm::vec3 point) { return field.control().coverage(point); };
    EXPECT_EQ(covered({2, 2, 2}), 1.0f);
    EXPECT_EQ(covered({4.5f, 2, 2}), 1.0f);
    EXPECT_NEAR(covered({4.75f, 2, 2}), 0.75f, 1e-5f);
    EXPECT_NEAR(covered({5.25f, 5.3f, 2}), 0.2f, 1e-5f) << "beyond an edge the farther axis counts";
    EXPECT_EQ(covered({5.5f, 2, 2}), 0.0f);
    EXPECT_EQ(covered({12, 2, -2}), 1.0f) << "turned: from z = 0 to -4";
    EXPECT_EQ(covered({12, 2, 3.5f}), 0.0f);
    EXPECT_NEAR(covered({12, 2, 2}), 0.5f, 1e-5f) << "cells of two metres";
    const std::vector<glm::vec3> points{{2, 2, 2}, {4.75f, 2, 2}, {99, 0, 0}};
    std::vector<float> all(3);
    ASSERT_TRUE(field.control().coverage(points, all));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(all[i], covered(points[i]));
    EXPECT_EQ(field.control().coverage(points, std::span(all).first(2)).error().code, ErrorCode::invalidArgument);
}

TEST(Volumes, sharesSumToOneAndTheNearestHasAllOutside) {
    const Field field = fieldOf({{.spacing = glm::vec3(1), .counts = glm::ivec3(7)},
                                 {.origin = glm::vec3(2), .spacing = glm::vec3(0.5f), .counts = glm::ivec3(5)}});
    const auto shares = [&](glm::vec3 point) { return field.control().volumeShares(point).value(); };
    EXPECT_EQ(shares({3, 3, 3}), (std::vector<float>{0, 1}));
    EXPECT_EQ(shares({1.2f, 3, 3}), (std::vector<float>{1, 0}));
    EXPECT_NEAR(shares({2.125f, 3, 3})[1], 0.25f, 1e-5f);
    EXPECT_NEAR(shares({2.125f, 3, 3})[0], 0.75f, 1e-5f);
    EXPECT_EQ(shares({-9, 3, 3}), (std::vector<float>{1, 0}));
}

TEST(Volumes, followACameraBeyondTheDeadBand) {
    const VolumeDesc v{.origin = {-2, -1, -2}, .spacing = {1, 0.5f, 1}, .counts = {5, 5, 5}};
    EXPECT_EQ(cellsToFollow(v, {0.7f, 0.37f, -0.7f}), glm::ivec3(0));
    EXPECT_EQ(cellsToFollow(v, {0.8f, 0.38f, -0.8f}), glm::ivec3(1, 1, -1));
    EXPECT_EQ(cellsToFollow(v, {0.8f, 0, 0}), glm::ivec3(1, 0, 0)) << "each axis for itself";
    EXPECT_EQ(cellsToFollow(v, {-7.2f, 0, 0}), glm::ivec3(-7, 0, 0));
    EXPECT_EQ(cellsToFollow(v, {0.6f, 0, 0}, 0.0f), glm::ivec3(1, 0, 0));
    EXPECT_EQ(cellsToFollow(v, {0.95f, 0, 0}, 0.5f), glm::ivec3(0));
    EXPECT_EQ(cellsToFollow(v, glm::vec3(std::numeric_limits<float>::quiet_NaN())), glm::ivec3(0));
}

TEST(Volumes, trackingNeedsAMiddle) {
    const auto made = [](int count, bool tracks) {
        FieldDesc desc;
        desc.volumes = {{.counts = {6, count, 6}, .tracksCamera = tracks}};
        return Field::create(Context::create({.threads = 1}).value(), desc);
    };
    EXPECT_TRUE(made(4, false));
    EXPECT_TRUE(made(5, true));
    ASSERT_FALSE(made(4, true));
    EXPECT_THAT(made(4, true).error().message, HasSubstr("tracksCamera needs at least 5 probes"));
    FieldSettings settings;
    settings.outsideRadiance.y = -1;
    Field field = fieldOf({VolumeDesc{}});
    EXPECT_THAT(field.control().setSettings(settings).error().message, HasSubstr("outsideRadiance"));
    settings = {};
    settings.camera = glm::vec3(0, 0, std::numeric_limits<float>::infinity());
    EXPECT_THAT(field.control().setSettings(settings).error().message, HasSubstr("camera"));
}

}  // namespace
}  // namespace probegi
