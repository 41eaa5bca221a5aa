#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "probegi/measure.h"

namespace probegi {
namespace {

constexpr float kPi = 3.14159265f;

/// 12 x 2 x 2 probes a metre apart; the first six along x see `left`, the others `right`, from all sides.
Field halves(glm::vec3 left, glm::vec3 right) {
    FieldDesc desc;
    desc.volumes = {{glm::vec3(0), glm::vec3(1), {12, 2, 2}}};
    desc.raysPerProbe = 16;
    Field field = *Field::create(*Context::create({.threads = 1}), desc);
    std::vector<RayDatum> data;
    for (int i = 0; i < 12 * 2 * 2 * 16; ++i) data.push_back({i / 16 % 12 < 6 ? left : right, 100.0f});
    EXPECT_TRUE(field.update(data));
    return field;
}

const std::vector<FieldQuery> kLeft{{{1.5f, 0.5f, 0.5f}, {0, 1, 0}, {}}, {{2.5f, 0.5f, 0.3f}, {0, 0, 1}, {}}};
const std::vector<FieldQuery> kRight{{{9.5f, 0.5f, 0.5f}, {0, 1, 0}, {}}};

TEST(LightAtPoints, isTheMeanOfTheChannels) {
    const Field field = halves({1, 2, 6}, glm::vec3(1));
    const auto light = lightAt(field, kLeft);
    ASSERT_TRUE(light);
    ASSERT_EQ(light->size(), 2u);
    for (const double e : *light) EXPECT_NEAR(e, 3 * kPi, 0.03 * kPi);
    EXPECT_NEAR(*meanLight(field, kLeft), 3 * kPi, 0.03 * kPi);
    EXPECT_EQ(*meanLight(field, {}), 0);
}

TEST(LeakShare, isDarkOverLit) {
    EXPECT_NEAR(*leakShare(halves(glm::vec3(0.02f), glm::vec3(2)), kLeft, kRight), 0.01, 1e-4);
    EXPECT_EQ(*leakShare(halves(glm::vec3(0), glm::vec3(2)), kLeft, kRight), 0);
    EXPECT_EQ(*leakShare(halves(glm::vec3(1), glm::vec3(0)), kLeft, kRight), std::numeric_limits<double>::infinity());
}

TEST(WallPoints, lieOnTheSixFacesAndFaceInwards) {
    const Bounds room{{1, 2, 3}, {2, 4, 6}};
    const std::vector<FieldQuery> points = wallPoints(room, 4);
    ASSERT_EQ(points.size(), 6u * 16u);
    glm::vec3 sum(0), normals(0);
    for (const FieldQuery& q : points) {
        const float out = glm::dot(q.position - room.centre(), q.normal);
        EXPECT_NEAR(out, -0.5f * std::abs(glm::dot(room.size(), q.normal)), 1e-5f) << "on a face, from the inside";
        EXPECT_NEAR(glm::length(glm::cross(q.toViewer, room.centre() - q.position)), 0, 1e-5f);
        EXPECT_NEAR(glm::length(q.toViewer), 1, 1e-5f);
        for (int a = 0; a < 3; ++a) {
            if (q.normal[a] != 0) continue;
            const float cell = (q.position[a] - room.lower[a]) / room.size()[a] * 4 - 0.5f;
            EXPECT_NEAR(cell, std::round(cell), 1e-4f) << "the middles of 4 x 4 cells";
        }
        sum += q.position;
        normals += q.normal;
    }
    EXPECT_NEAR(glm::length(sum / 96.0f - room.centre()), 0, 1e-4f);
    EXPECT_EQ(normals, glm::vec3(0));
}

TEST(CompareLight, byHand) {
    const double light[] = {1, 3, 2}, reference[] = {1, 1, 2};
    const auto d = compareLight(light, reference);
    ASSERT_TRUE(d);
    EXPECT_DOUBLE_EQ(d->mean, 6.0 / 4);
    EXPECT_DOUBLE_EQ(d->rms, std::sqrt(4.0 / 3) / (4.0 / 3));
}

TEST(CompareLight, ofBlackAndOfUnequalLengths) {
    const double some[] = {1, 2}, black[] = {0, 0}, three[] = {1, 2, 3};
    EXPECT_EQ(compareLight(some, black)->rms, 0);
    EXPECT_EQ(compareLight(some, black)->mean, 0);
    const auto refused = compareLight(some, three);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalidArgument);
}

}  // namespace
}  // namespace probegi
