// The limits of every member of FieldDesc: the last value that is taken and the first that is not.
#include <gtest/gtest.h>

#include <cmath>

#include "field/layout.h"

namespace probegi {
namespace {

template <class Edit>
void expectRange(const char* name, Edit edit, double lowest, double highest, double step) {
    const auto accepts = [&](double value) {
        FieldDesc d;
        edit(d, value);
        const auto ok = validateFieldDesc(d);
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
        "raysPerProbe", [](FieldDesc& d, double v) { d.raysPerProbe = int(v); }, 8, 4096, 1);
    expectRange(
        "fixedRays", [](FieldDesc& d, double v) { d.fixedRays = int(v); }, 0, 256, 1);
    expectRange(
        "irradianceTexels", [](FieldDesc& d, double v) { d.irradianceTexels = int(v); }, 4, 32, 2);
    expectRange(
        "irradianceTexels", [](FieldDesc& d, double v) { d.irradianceTexels = int(v); }, 6, 30, 1);
    expectRange(
        "visibilityTexels", [](FieldDesc& d, double v) { d.visibilityTexels = int(v); }, 4, 64, 2);
    expectRange(
        "hysteresis", [](FieldDesc& d, double v) { d.hysteresis = float(v); }, 0, 0.999f, 1e-3);
    expectRange(
        "visibilityHysteresis", [](FieldDesc& d, double v) { d.visibilityHysteresis = float(v); }, 0, 0.999f, 1e-3);
    expectRange(
        "visibilityExponent", [](FieldDesc& d, double v) { d.visibilityExponent = float(v); }, 1, 500, 0.5);
    expectRange(
        "selfShadowBias", [](FieldDesc& d, double v) { d.selfShadowBias = float(v); }, 0, 2, 0.01);
    expectRange(
        "significantChange", [](FieldDesc& d, double v) { d.significantChange = float(v); }, 0, 1, 0.01);
    expectRange(
        "newDistribution", [](FieldDesc& d, double v) { d.newDistribution = float(v); }, 0, 1, 0.01);
    expectRange(
        "emitterSamples", [](FieldDesc& d, double v) { d.emitterSamples = int(v); }, 0, 16, 1);
    for (int axis = 0; axis < 3; ++axis) {
        expectRange(
            "grid.counts", [&](FieldDesc& d, double v) { d.grid.counts[axis] = int(v); }, 2, 1024, 1);
        FieldDesc flat;
        flat.grid.spacing[axis] = 0;
        EXPECT_FALSE(validateFieldDesc(flat)) << axis;
    }
}

TEST(FieldDescLimits, ofTheSpacing) {
    for (const auto& [spacing, taken] : {std::pair{1e-6f, true}, {0.99e-6f, false}, {1e9f, true}, {1.01e9f, false}}) {
        FieldDesc d;
        d.grid.spacing = glm::vec3(spacing);
        EXPECT_EQ(bool(validateFieldDesc(d)), taken) << spacing;
    }
}

TEST(FieldDescLimits, ofAllProbesTogether) {
    FieldDesc d;
    d.grid.counts = {1024, 128, 128};
    EXPECT_TRUE(validateFieldDesc(d));
    d.grid.counts = {1024, 128, 129};
    EXPECT_FALSE(validateFieldDesc(d));
    d.grid.counts = {2, 2, 2};
    EXPECT_TRUE(validateFieldDesc(d));
}

// Where 32 units of the last place of a coordinate are a quarter of the spacing; either end of the grid may be
// farthest.
TEST(FieldDescLimits, coordinatesMustBeFinerThanTheGrid) {
    const float unit = 32 * 1.1920929e-7f;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            const auto acceptedAt = [&](float farthest) {
                FieldDesc d;
                d.grid = {glm::vec3(0.0f), glm::vec3(1.0f), glm::ivec3(8)};
                d.grid.origin[axis] = sign > 0 ? farthest - 7 : -farthest;
                return bool(validateFieldDesc(d));
            };
            EXPECT_TRUE(acceptedAt(0.249f / unit)) << axis << sign;
            EXPECT_FALSE(acceptedAt(0.251f / unit)) << axis << sign;
        }
}

// The narrowest axis counts, whichever it is.
TEST(FieldDescLimits, coordinatesMustBeFinerThanTheNarrowestAxis) {
    for (int narrow = 0; narrow < 3; ++narrow) {
        FieldDesc d;
        d.grid = {glm::vec3(0.0f), glm::vec3(1.0f), glm::ivec3(8)};
        d.grid.origin[(narrow + 1) % 3] = 1000;  // where 32 units are 4 mm
        EXPECT_TRUE(validateFieldDesc(d));
        d.grid.spacing[narrow] = 0.014f;
        EXPECT_FALSE(validateFieldDesc(d)) << narrow;
        d.grid.spacing[narrow] = 0.017f;
        EXPECT_TRUE(validateFieldDesc(d)) << narrow;
    }
}

TEST(FieldLayout, sizesFollowFromTheDescription) {
    FieldDesc d;
    d.grid = {glm::vec3(0.0f), {2, 3, 6}, {2, 3, 4}};
    d.raysPerProbe = 10;
    d.irradianceTexels = 6;
    d.visibilityTexels = 10;
    const FieldLayout layout(d);
    EXPECT_EQ(layout.probes, 24u);
    EXPECT_EQ(layout.rays, 10u);
    EXPECT_EQ(layout.irradianceTexels, 36u);
    EXPECT_EQ(layout.visibilityTexels, 100u);
    EXPECT_FLOAT_EQ(layout.maxDistance, 1.5f * 7) << "the cell's diagonal and half of it";
}

}  // namespace
}  // namespace probegi
