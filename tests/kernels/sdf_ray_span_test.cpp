#include "kernels/sdf/ray_span.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "kernels/sdf_solids.h"

namespace probegi::kernels {
namespace {

// Plain sphere tracing from outside; nullopt: nothing within `far`.
std::optional<float> sphereTraced(const SdfSolid& solid, vec3 origin, vec3 direction, float far) {
    float t = 0;
    for (int step = 0; step < 20000 && t < far; ++step) {
        const float distance = sdfDistance(solid, origin + direction * t);
        if (distance < 5e-6f) return t;
        t += distance;
    }
    return std::nullopt;
}

TEST(SdfRaySpan, closedForms) {
    const auto expectSpan = [](const SdfSolid& solid, vec3 origin, vec3 direction, float entry, float exit) {
        const SdfSpan span = sdfRaySpan(solid, origin, direction);
        EXPECT_NEAR(span.entry, entry, 1e-5);
        EXPECT_NEAR(span.exit, exit, 1e-5);
    };
    expectSpan(plainSolid(kSdfBox, {1, 2, 3}), {-5, 0, 0}, {1, 0, 0}, 4, 6);
    expectSpan(plainSolid(kSdfBox, {1, 2, 3}), {0, 0, 0}, {0, 0, -1}, -3, 3);
    expectSpan(plainSolid(kSdfRoundedBox, {1, 2, 3}, 0.5f), {-5, 0, 0}, {1, 0, 0}, 4, 6);
    // Along x past the core's upper edge at a height of 0.3: 0.4 short of the flat faces.
    expectSpan(plainSolid(kSdfRoundedBox, {1, 2, 3}, 0.5f), {-5, 1.8f, 0}, {1, 0, 0}, 4.1f, 5.9f);
    expectSpan(plainSolid(kSdfSphere, {1, 9, 9}), {-5, 0.6f, 0}, {1, 0, 0}, 4.2f, 5.8f);
    expectSpan(plainSolid(kSdfCapsule, {1, 2, 9}), {-5, 2.6f, 0}, {1, 0, 0}, 4.2f, 5.8f);
    expectSpan(plainSolid(kSdfCapsule, {1, 2, 9}), {0, 9, 0}, {0, -1, 0}, 6, 12);
    expectSpan(plainSolid(kSdfCylinder, {1, 2, 9}), {0.5f, 9, 0}, {0, -1, 0}, 7, 11);
    expectSpan(plainSolid(kSdfCylinder, {1, 2, 9}), {-5, 1.9f, 0.6f}, {1, 0, 0}, 4.2f, 5.8f);
    EXPECT_NEAR(sdfRaySpan(plainSolid(kSdfPlane, {}), {0, 3, 0}, {0, -0.6f, 0.8f}).entry, 5, 1e-6);
    EXPECT_EQ(sdfRaySpan(plainSolid(kSdfPlane, {}), {0, 3, 0}, {0, -0.6f, 0.8f}).exit, kSdfFar);
    EXPECT_NEAR(sdfRaySpan(plainSolid(kSdfPlane, {}), {0, -3, 0}, {0, 1, 0}).exit, 3, 1e-6);
    EXPECT_EQ(sdfRaySpan(plainSolid(kSdfPlane, {}), {0, -3, 0}, {0, 1, 0}).entry, -kSdfFar);
}

// Its ends are on the surface, its middle is inside, and sphere tracing finds the same entry.
TEST(SdfRaySpan, isWhatSphereTracingFinds) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        int hits = 0;
        for (int i = 0; i < 3000; ++i) {
            const SdfSolid solid = randomSolid(dice, shape);
            const vec3 origin = dice.vector(-4, 4);
            if (sdfDistance(solid, origin) < 0.01f) continue;
            const vec3 direction =
                i % 2 == 0 ? normalize(solid.centre + dice.vector(-1, 1) - origin) : dice.direction();
            const SdfSpan span = sdfRaySpan(solid, origin, direction);
            if (std::abs(span.entry - 40) < 1) continue;  // for rounding to decide
            const bool exact = span.entry <= span.exit && span.exit >= 0 && span.entry < 40;
            const auto traced = sphereTraced(solid, origin, direction, 40);
            if (exact != traced.has_value()) {
                // Rays that barely touch are for rounding to decide.
                float nearest = kSdfFar;
                for (float t = 0; t < 40; t += 1e-3f)
                    nearest = min(nearest, sdfDistance(solid, origin + direction * t));
                ASSERT_NEAR(nearest, 0, 1e-3) << shape;
                continue;
            }
            if (!exact) continue;
            ++hits;
            ASSERT_NEAR(sdfDistance(solid, origin + direction * span.entry), 0, 1e-5) << shape;
            // The ends of tracing are oblique: a distance of 5e-6 along a grazing ray is further.
            const float cosine = -dot(direction, sdfGradient(solid, origin + direction * *traced));
            ASSERT_NEAR(span.entry, *traced, 1e-4f + 2e-5f / max(cosine * cosine, 1e-4f)) << shape;
            if (shape == kSdfPlane) continue;
            ASSERT_NEAR(sdfDistance(solid, origin + direction * span.exit), 0, 1e-5) << shape;
            ASSERT_LT(sdfDistance(solid, origin + direction * (0.5f * (span.entry + span.exit))), 1e-6f) << shape;
        }
        EXPECT_GT(hits, 400) << shape;
    }
}

// From far away, and for thin solids, a point of the surface is still met to within a few units in the last place.
TEST(SdfRaySpan, farOriginsAndThinSolids) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        for (int i = 0; i < 3000; ++i) {
            SdfSolid solid = randomSolid(dice, shape);
            if (i % 2 == 0) solid.halfSize[i / 2 % 3] = solid.rounding = 1e-3f;
            const vec3 direction = dice.direction();
            const vec3 origin = solid.centre - direction * dice.between(50, 200);
            const SdfSpan span = sdfRaySpan(solid, origin, direction);
            ASSERT_LE(span.entry, span.exit) << shape;
            if (span.entry > -kSdfFar) {
                ASSERT_NEAR(sdfDistance(solid, origin + direction * span.entry), 0, 1e-4) << shape << ' ' << i;
            }
            if (span.exit < kSdfFar) {
                ASSERT_NEAR(sdfDistance(solid, origin + direction * span.exit), 0, 1e-4) << shape << ' ' << i;
            }
        }
    }
}

// Directions along the axes, past all shapes and through them, from inside and from their surface.
TEST(SdfRaySpan, directionsAlongAxes) {
    for (const uint shape : kSdfShapes) {
        const SdfSolid solid = plainSolid(shape, {1, 1, 1}, 0.25f);
        const float height = shape == kSdfCapsule ? 2.0f : 1.0f;
        const float top = shape == kSdfPlane ? 0 : height;
        for (const float side : {-1.0f, 1.0f}) {
            const SdfSpan past = sdfRaySpan(solid, {-4, 2.5f, 0}, {side, 0, 0});
            EXPECT_GT(past.entry, past.exit) << shape;
            const SdfSpan through = sdfRaySpan(solid, {0, -0.5f, 0}, {side, 0, 0});
            EXPECT_LT(through.entry, 0) << shape;
            EXPECT_GT(through.exit, 0.8f) << shape;
        }
        const SdfSpan down = sdfRaySpan(solid, {0, top, 0}, {0, -1, 0}), up = sdfRaySpan(solid, {0, top, 0}, {0, 1, 0});
        EXPECT_NEAR(down.entry, 0, 1e-6) << shape;
        EXPECT_NEAR(up.exit, 0, 1e-6) << shape;
        EXPECT_GT(down.exit, 1.9f) << shape;
    }
}

// What is parallel to a surface is within it up to the surface itself.
TEST(SdfRaySpan, alongTheSurface) {
    const SdfSpan ground = sdfRaySpan(plainSolid(kSdfPlane, {}), {3, 0, 1}, {1, 0, 0});
    EXPECT_EQ(ground.entry, -kSdfFar);
    EXPECT_EQ(ground.exit, kSdfFar);
    const SdfSpan side = sdfRaySpan(plainSolid(kSdfCylinder, {1, 2, 9}), {1, -5, 0}, {0, 1, 0});
    EXPECT_NEAR(side.entry, 3, 1e-6);
    EXPECT_NEAR(side.exit, 7, 1e-6);
}

TEST(SdfRaySpan, spansOfBothAndOfEither) {
    const SdfSpan a = sdfSpan(1, 3), b = sdfSpan(2, 5);
    EXPECT_EQ(sdfBothSpans(a, b).entry, 2);
    EXPECT_EQ(sdfBothSpans(a, b).exit, 3);
    EXPECT_EQ(sdfEitherSpan(a, b).entry, 1);
    EXPECT_EQ(sdfEitherSpan(a, b).exit, 5);
    EXPECT_EQ(sdfEitherSpan(sdfNoSpan(), b).exit, 5);
    EXPECT_EQ(sdfEitherSpan(a, sdfNoSpan()).entry, 1);
}

}  // namespace
}  // namespace probegi::kernels
