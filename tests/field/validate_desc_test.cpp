// The limits of every member of FieldDesc: the last valid value and the first invalid one.
#include <gtest/gtest.h>

#include <cmath>

#include "field/layout.h"
#include "support/field_setup.h"

namespace probegi {
namespace {

using test::FieldSetup;

Result<void> validate(const FieldSetup& setup) {
    return validateFieldDesc(setup).and_then([&] { return validateFieldSettings(setup); });
}

template <class Edit>
void expectRange(const char* name, Edit edit, double lowest, double highest, double step) {
    const auto accepts = [&](double value) {
        FieldSetup d;
        edit(d, value);
        const auto ok = validate(d);
        EXPECT_TRUE(ok || ok.error().message.find(name) != std::string::npos) << name;
        return bool(ok);
    };
    EXPECT_TRUE(accepts(lowest)) << name;
    EXPECT_TRUE(accepts(highest)) << name;
    EXPECT_FALSE(accepts(lowest - step)) << name;
    EXPECT_FALSE(accepts(highest + step)) << name;
}

TEST(FieldDescLimits, areThoseOfTheHeader) {
    expectRange(
        "raysPerProbe", [](FieldSetup& d, double v) { d.raysPerProbe = int(v); }, 8, 4096, 1);
    expectRange(
        "fixedRays", [](FieldSetup& d, double v) { d.fixedRays = int(v); }, 0, 256, 1);
    expectRange(
        "irradianceTexels", [](FieldSetup& d, double v) { d.irradianceTexels = int(v); }, 4, 32, 2);
    expectRange(
        "irradianceTexels", [](FieldSetup& d, double v) { d.irradianceTexels = int(v); }, 6, 30, 1);
    expectRange(
        "visibilityTexels", [](FieldSetup& d, double v) { d.visibilityTexels = int(v); }, 4, 64, 2);
    expectRange(
        "hysteresis", [](FieldSetup& d, double v) { d.hysteresis = float(v); }, 0, 0.999f, 1e-3);
    expectRange(
        "visibilityHysteresis", [](FieldSetup& d, double v) { d.visibilityHysteresis = float(v); }, 0, 0.999f, 1e-3);
    expectRange(
        "visibilityExponent", [](FieldSetup& d, double v) { d.visibilityExponent = float(v); }, 1, 500, 0.5);
    expectRange(
        "selfShadowBias", [](FieldSetup& d, double v) { d.selfShadowBias = float(v); }, 0, 2, 0.01);
    expectRange(
        "significantChange", [](FieldSetup& d, double v) { d.significantChange = float(v); }, 0, 1, 0.01);
    expectRange(
        "newDistribution", [](FieldSetup& d, double v) { d.newDistribution = float(v); }, 0, 1, 0.01);
    expectRange(
        "emitterSamples", [](FieldSetup& d, double v) { d.emitterSamples = int(v); }, 0, 16, 1);
    for (int axis = 0; axis < 3; ++axis) {
        expectRange(
            "volumes[0].counts", [&](FieldSetup& d, double v) { d.volumes[0].counts[axis] = int(v); }, 2, 1024, 1);
        FieldSetup flat;
        flat.volumes[0].spacing[axis] = 0;
        EXPECT_FALSE(validate(flat)) << axis;
    }
}

TEST(FieldDescLimits, ofTheSpacing) {
    for (const auto& [spacing, taken] : {std::pair{1e-6f, true}, {0.99e-6f, false}, {1e9f, true}, {1.01e9f, false}}) {
        FieldSetup d;
        d.volumes[0].spacing = glm::vec3(spacing);
        EXPECT_EQ(bool(validate(d)), taken) << spacing;
    }
}

TEST(FieldDescLimits, ofAllProbesTogether) {
    FieldSetup d;
    d.volumes[0].counts = {1024, 128, 128};
    EXPECT_TRUE(validate(d));
    d.volumes[0].counts = {1024, 128, 129};
    EXPECT_FALSE(validate(d));
    d.volumes[0].counts = {2, 2, 2};
    EXPECT_TRUE(validate(d));
}

// The limit is where 32 units in the last place of a coordinate are a quarter of the spacing; either end of the grid
// may be the farthest.
TEST(FieldDescLimits, coordinatesMustBeFinerThanTheGrid) {
    const float unit = 32 * 1.1920929e-7f;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            const auto acceptedAt = [&](float farthest) {
                FieldSetup d;
                d.volumes[0] = {glm::vec3(0.0f), glm::vec3(1.0f), glm::ivec3(8)};
                d.volumes[0].origin[axis] = sign > 0 ? farthest - 7 : -farthest;
                return bool(validate(d));
            };
            EXPECT_TRUE(acceptedAt(0.249f / unit)) << axis << sign;
            EXPECT_FALSE(acceptedAt(0.251f / unit)) << axis << sign;
        }
}

// The axis with the least spacing counts, whichever it is.
TEST(FieldDescLimits, coordinatesMustBeFinerThanTheNarrowestAxis) {
    for (int narrow = 0; narrow < 3; ++narrow) {
        FieldSetup d;
        d.volumes[0] = {glm::vec3(0.0f), glm::vec3(1.0f), glm::ivec3(8)};
        d.volumes[0].origin[(narrow + 1) % 3] = 1000;  // 32 units in the last place are 4 mm here
        EXPECT_TRUE(validate(d));
        d.volumes[0].spacing[narrow] = 0.014f;
        EXPECT_FALSE(validate(d)) << narrow;
        d.volumes[0].spacing[narrow] = 0.017f;
        EXPECT_TRUE(validate(d)) << narrow;
    }
}

TEST(FieldLayout, sizesFollowFromTheDescription) {
    FieldSetup d;
    d.volumes[0] = {glm::vec3(0.0f), {2, 3, 6}, {2, 3, 4}};
    d.raysPerProbe = 10;
    d.irradianceTexels = 6;
    d.visibilityTexels = 10;
    const FieldLayout layout(d);
    EXPECT_EQ(layout.probes, 24u);
    EXPECT_EQ(layout.rays, 10u);
    EXPECT_EQ(layout.irradianceTexels, 36u);
    EXPECT_EQ(layout.visibilityTexels, 100u);
    EXPECT_FLOAT_EQ(visibilityRange(d.volumes[0]), 1.5f * 7) << "the cell's diagonal and half of it";
}

}  // namespace
}  // namespace probegi
