// Windows of a whole field with given ray data: probes that see a change follow it at once, and so do their neighbours.
#include <gtest/gtest.h>

#include <optional>

#include "kernels/random.h"
#include "probegi/field.h"
#include "support/field_setup.h"
#include "support/probes.h"

namespace probegi {
namespace {

using test::FieldSetup;

constexpr int kAlong = 6, kRays = 256, kFixed = 16;

struct Row {
    FieldSetup desc;
    float light = 1, distance = 1;  // of the update rays; the light varies evenly from 0.5 to 1.5 times this
    std::vector<RayDatum> rays;
    std::vector<FixedRayDatum> fixed;
    std::optional<Field> field;
    std::uint32_t state = 7;

    Row() {
        desc.volumes = {{glm::vec3(0.0f), glm::vec3(1.0f), {kAlong, 2, 2}}};
        desc.raysPerProbe = kRays;
        desc.fixedRays = kFixed;
        rays.resize(std::size_t(probeCount(desc)) * kRays);
        fixed.assign(std::size_t(probeCount(desc)) * kFixed, {1, 0, 1});
        field.emplace(*Field::create(*Context::create({.threads = 2}), desc, desc));
    }
    void update(int times, bool withFixedRays = true) {
        for (int i = 0; i < times; ++i) {
            for (RayDatum& r : rays) {
                const bool back = r.distance < 0;
                r = {glm::vec3(light * (0.5f + kernels::nextRandom(state))), back ? -distance : distance};
            }
            ASSERT_TRUE(field->update(rays, withFixedRays ? fixed : std::vector<FixedRayDatum>()));
        }
    }
    /// Share of the way from light 1 to light 3 that the x-th probe of the first row has gone.
    float followed(int x) const { return (test::probeIrradiance(*field, x, {0, 1, 0}).x / 3.14159265f - 1) / 2; }
    float meanDistance(int x) const { return test::probeDistanceMoments(*field, x, {0, 1, 0}).x; }
};

TEST(FieldWindows, stillLightIsAveraged) {
    Row row;
    row.update(40);
    for (int x = 0; x < kAlong; ++x) {
        EXPECT_NEAR(row.followed(x), 0, 0.02);
        EXPECT_NEAR(row.meanDistance(x), 1, 1e-3);
    }
}

// The light of all rays changes, but only the first probe's fixed rays show it.
TEST(FieldWindows, neighboursOfAProbeThatLagsFollow) {
    Row row;
    row.update(40);
    row.light = 3;
    for (std::size_t i = 0; i < kFixed; ++i) row.fixed[i].direct = 3;
    row.update(1);
    EXPECT_NEAR(row.followed(0), 1, 0.25);
    EXPECT_NEAR(row.followed(1), 1, 0.25) << "a neighbour";
    // The others' windows have grown by half a frame per update, so that they admit a twentieth.
    for (int x = 2; x < kAlong; ++x) EXPECT_NEAR(row.followed(x), 0.05, 0.04) << x;
}

// The same at the other end of the grid, across all three axes.
TEST(FieldWindows, theLastProbeIsANeighbourToo) {
    Row row;
    row.update(40);
    row.light = 3;
    for (std::size_t i = 0; i < kFixed; ++i) row.fixed[row.fixed.size() - 1 - i].direct = 3;
    row.update(1);
    EXPECT_NEAR(row.followed(4 * kAlong - 1), 1, 0.25);
    EXPECT_NEAR(row.followed(kAlong - 1), 1, 0.25) << "a neighbour along y and z";
    EXPECT_NEAR(row.followed(kAlong - 2), 1, 0.25) << "along all axes";
    EXPECT_NEAR(row.followed(kAlong - 3), 0.05, 0.04);
}

TEST(FieldWindows, distancesHaveWindowsOfTheirOwn) {
    Row row;
    row.update(40);
    row.light = 3;
    row.distance = 2;
    for (std::size_t i = 0; i < kFixed; ++i) row.fixed[i].distance = 2;
    row.update(1);
    EXPECT_NEAR(row.meanDistance(0), 2, 0.05);
    EXPECT_GT(row.meanDistance(1), 1.3f);
    EXPECT_NEAR(row.meanDistance(3), 1.05, 0.03);
    EXPECT_LT(row.followed(0), 0.12f) << "light did not lag as far as fixed rays tell";
}

// Without fixed rays the update's own are used: a change beyond their noise is followed.
TEST(FieldWindows, ownRaysShowLargeChanges) {
    Row row;
    row.update(40, false);
    for (int x = 0; x < kAlong; ++x) EXPECT_NEAR(row.followed(x), 0, 0.03) << x;
    row.light = 3;
    row.update(1, false);
    for (int x = 0; x < kAlong; ++x) EXPECT_NEAR(row.followed(x), 1, 0.25) << x;
}

// Neighbours ignore probes in walls.
TEST(FieldWindows, probesInWallsAreIgnored) {
    Row row;
    for (std::size_t i = 0; i < kRays; ++i) row.rays[i].distance = -1;
    row.update(40);
    EXPECT_GT(test::probeBackfaceShare(*row.field, 0), 0.9f);
    EXPECT_LT(test::probeBackfaceShare(*row.field, 1), 0.01f);
    row.light = 3;
    for (std::size_t i = 0; i < kFixed; ++i) row.fixed[i].direct = 3;
    row.update(1);
    EXPECT_LT(row.followed(1), 0.12f);
}

// A constant field is constant everywhere, in and around the grid, for every normal.
TEST(FieldQueryTest, aConstantFieldIsConstant) {
    Row row;
    for (RayDatum& r : row.rays) r = {glm::vec3(1.0f), 1.0f};
    for (const FieldRules rules : {FieldRules::measured, FieldRules::paper})
        for (const LeakGuard guard : {LeakGuard::none, LeakGuard::moments}) {
            FieldSetup desc = row.desc;
            desc.guard = guard;
            desc.rules = rules;
            Field field = *Field::create(*Context::create({.threads = 1}), desc, desc);
            ASSERT_TRUE(field.update(row.rays));
            for (const glm::vec3 at : {glm::vec3(2.3f, 0.4f, 0.7f), glm::vec3(0, 0, 0), glm::vec3(-3, 9, 0.5f)})
                for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, -0.8f)}) {
                    const glm::vec3 e = field.irradiance({at, n});
                    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c] / 3.14159265f, 1, 2e-3);
                }
        }
}

}  // namespace
}  // namespace probegi
