#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "analytic/field_scene.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

constexpr float kPi = 3.14159265f;

struct FurnaceCase {
    float albedo, emission;
};

class FieldFurnace : public testing::TestWithParam<FurnaceCase> {};

// Closed box of albedo a and emission Le: E = pi Le / (1 - a) at every point and normal, to 1 %.
TEST_P(FieldFurnace, everyPointHasTheClosedForm) {
    const auto [albedo, emission] = GetParam();
    // The missing light shrinks as (1 - (1 - hysteresis) (1 - albedo))^frames.
    test::FieldScene s("furnace", {.albedo = albedo, .emission = emission}, {.counts = {6, 6, 6}},
                       FieldSetup({}, {.hysteresis = 0.8f}));
    s.run(int(30 / (1 - albedo)));
    const double expected = kPi * emission / (1 - albedo);
    for (const FieldQuery& q : s.surfaceQueries(400))
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.field.irradiance(q)[c] / expected, 1.0, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Levels, FieldFurnace,
                         testing::Values(FurnaceCase{0, 1e-3f}, FurnaceCase{0, 1e3f}, FurnaceCase{0.5f, 1e-3f},
                                         FurnaceCase{0.5f, 1}, FurnaceCase{0.5f, 1e3f}, FurnaceCase{0.9f, 1e-3f},
                                         FurnaceCase{0.9f, 1}, FurnaceCase{0.9f, 1e3f}));

// Storage must preserve energy in both directions: after a change of brightness, plain hysteresis reaches the new level
// from below and from above, in steps far smaller than those of the storage format.
TEST(FieldLevels, brighteningAndDarkeningBothArrive) {
    for (const float hysteresis : {0.97f, 0.99f})
        for (const auto& [from, to] :
             {std::pair{1.0f, 1.1f}, {1.1f, 1.0f}, {1e-3f, 1e3f}, {1e3f, 1e-3f}, {5.0f, 4.9f}}) {
            FieldSetup desc;
            desc.rules = FieldRules::paper;
            desc.volumes = {{{0, 0, 0}, glm::vec3(1), {3, 3, 3}}};
            desc.hysteresis = hysteresis;
            desc.significantChange = desc.newDistribution = 0;
            Field field = *Field::create(*Context::create(), desc, desc);
            const auto data = [&](float radiance) {
                return std::vector<RayDatum>(27 * std::size_t(desc.raysPerProbe), {glm::vec3(radiance), 1.0f});
            };
            ASSERT_TRUE(field.update(data(from)));
            // The remaining difference shrinks as hysteresis^n: 4.6 time constants for 1 %, more for a change of 1e6.
            const int frames = int((from / to > 100 || to / from > 100 ? 12 : 7) / (1 - hysteresis));
            for (int i = 0; i < frames; ++i) ASSERT_TRUE(field.update(data(to)));
            for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, 0.8f)})
                EXPECT_NEAR(field.irradiance({glm::vec3(1.3f, 0.8f, 1.1f), n, n}).x / (kPi * to), 1.0, 0.01)
                    << from << " to " << to << " at " << hysteresis;
        }
}

}  // namespace
}  // namespace probegi
