#include "kernels/sdf/primitive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/sdf/distance.h"
#include "kernels/sdf/sdf_solid.h"
#include "kernels/sdf_solids.h"

namespace probegi::kernels {
namespace {

struct Case {
    vec3 point;
    float distance;
    vec3 gradient;
};

void expectAll(const SdfSolid& solid, std::initializer_list<Case> cases) {
    for (const Case& c : cases) {
        EXPECT_NEAR(sdfDistance(solid, c.point), c.distance, 1e-6) << c.point.x << ' ' << c.point.y << ' ' << c.point.z;
        EXPECT_LT(length(sdfGradient(solid, c.point) - c.gradient), 1e-6)
            << c.point.x << ' ' << c.point.y << ' ' << c.point.z;
    }
}

TEST(SdfPrimitive, box) {
    const float third = std::sqrt(1 / 3.0f);
    expectAll(plainSolid(kSdfBox, {1, 2, 3}), {
                                                  {{2, 0, 0}, 1, {1, 0, 0}},
                                                  {{0, -5, 1}, 3, {0, -1, 0}},
                                                  {{4, 6, 0}, 5, {0.6f, 0.8f, 0}},
                                                  {{-2, -3, -4}, std::sqrt(3.0f), {-third, -third, -third}},
                                                  {{0.75f, 0, 0}, -0.25f, {1, 0, 0}},
                                                  {{0, 1.5f, -2.75f}, -0.25f, {0, 0, -1}},
                                              });
}

TEST(SdfPrimitive, roundedBox) {
    expectAll(plainSolid(kSdfRoundedBox, {1, 2, 3}, 0.5f),
              {
                  {{2, 0, 0}, 1, {1, 0, 0}},
                  {{0.5f + 0.6f, 1.5f + 0.8f, 0}, 0.5f, {0.6f, 0.8f, 0}},
                  {{0.5f + 0.3f, 1.5f + 0.4f, 0}, 0, {0.6f, 0.8f, 0}},
                  {{0.5f + 0.06f, 1.5f + 0.08f, 0}, -0.4f, {0.6f, 0.8f, 0}},
                  {{0, 0, -2.25f}, -0.75f, {0, 0, -1}},
              });
}

TEST(SdfPrimitive, sphereAndPlane) {
    expectAll(plainSolid(kSdfSphere, {2, 9, 9}),
              {{{3, 0, 0}, 1, {1, 0, 0}}, {{0, 0, -1}, -1, {0, 0, -1}}, {{3, 0, -4}, 3, {0.6f, 0, -0.8f}}});
    expectAll(plainSolid(kSdfPlane, {9, 9, 9}), {{{3, 2, 1}, 2, {0, 1, 0}}, {{-50, -7, 1}, -7, {0, 1, 0}}});
}

TEST(SdfPrimitive, capsule) {
    expectAll(plainSolid(kSdfCapsule, {0.5f, 2, 9}), {
                                                         {{2, 1, 0}, 1.5f, {1, 0, 0}},
                                                         {{0, -4, 0}, 1.5f, {0, -1, 0}},
                                                         {{0, 2 + 3, 4}, 4.5f, {0, 0.6f, 0.8f}},
                                                         {{0, 1, 0.25f}, -0.25f, {0, 0, 1}},
                                                     });
    // Without a length it is a sphere.
    expectAll(plainSolid(kSdfCapsule, {0.5f, 0, 9}), {{{0, 3, 4}, 4.5f, {0, 0.6f, 0.8f}}});
}

TEST(SdfPrimitive, cylinder) {
    expectAll(plainSolid(kSdfCylinder, {0.5f, 2, 9}), {
                                                          {{0, 1, -2}, 1.5f, {0, 0, -1}},
                                                          {{0.25f, -4, 0}, 2, {0, -1, 0}},
                                                          {{3.5f, 2 + 4, 0}, 5, {0.6f, 0.8f, 0}},
                                                          {{0.375f, 1, 0}, -0.125f, {1, 0, 0}},
                                                          {{0.25f, 1.875f, 0}, -0.125f, {0, 1, 0}},
                                                      });
}

TEST(SdfPrimitive, standsAndTurns) {
    SdfSolid solid = plainSolid(kSdfBox, {1, 2, 3});
    solid.centre = {10, 20, 30};
    solid.rotation = {0, 0, std::sqrt(0.5f), std::sqrt(0.5f)};  // x to y, a quarter about z
    expectAll(solid, {{{10, 22, 30}, 1, {0, 1, 0}}, {{13, 20, 30}, 1, {1, 0, 0}}, {{10, 20, 26}, 1, {0, 0, -1}}});
}

// Eq. 3: the Lipschitz constant is 1, and along the gradient it is reached.
TEST(SdfPrimitive, distanceChangesNoFasterThanThePoint) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        for (int i = 0; i < 20000; ++i) {
            const SdfSolid solid = randomSolid(dice, shape, i % 4 == 0 ? 1e-4f : 0.05f);
            const vec3 a = dice.vector(-4, 4);
            const vec3 b = i % 2 == 0 ? dice.vector(-4, 4) : a + dice.direction() * dice.between(0, 0.2f);
            ASSERT_LE(std::abs(sdfDistance(solid, a) - sdfDistance(solid, b)), length(a - b) + 2e-6f) << shape;
        }
    }
}

// The closest point of the surface is a signed distance away, against the gradient, and has the same gradient.
TEST(SdfPrimitive, gradientLeadsToTheClosestPoint) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        for (int i = 0; i < 20000; ++i) {
            const SdfSolid solid = randomSolid(dice, shape);
            const vec3 point = dice.vector(-4, 4);
            const float distance = sdfDistance(solid, point);
            const vec3 gradient = sdfGradient(solid, point);
            ASSERT_NEAR(length(gradient), 1, 1e-5) << shape;
            ASSERT_NEAR(sdfDistance(solid, point - gradient * distance), 0, 1e-5) << shape << ' ' << distance;
            const vec3 step = gradient * 1e-3f;
            ASSERT_NEAR(sdfDistance(solid, point + step) - distance, 1e-3, 5e-5) << shape << ' ' << distance;
        }
    }
}

// Where the gradient leads from outside, the surface's normal is the gradient, or at a sharp edge that of a face there.
TEST(SdfPrimitive, surfaceNormalIsTheGradient) {
    SdfDice dice;
    for (const uint shape : kSdfShapes) {
        const bool sharp = shape == kSdfBox || shape == kSdfCylinder;
        int edges = 0;
        for (int i = 0; i < 5000; ++i) {
            const SdfSolid solid = randomSolid(dice, shape);
            const vec3 point = dice.vector(-4, 4);
            const vec3 gradient = sdfGradient(solid, point);
            const vec3 normal = sdfSurfaceNormal(solid, point - gradient * sdfDistance(solid, point));
            ASSERT_NEAR(length(normal), 1, 1e-5);
            if (length(normal - gradient) < 1e-3f) continue;
            ++edges;
            ASSERT_TRUE(sharp) << shape;
            ASSERT_GT(dot(normal, gradient), -1e-3f);
        }
        EXPECT_EQ(edges > 100, sharp) << shape;
    }
}

// Centres and axes have no one gradient; what is returned is unit all the same.
TEST(SdfPrimitive, directionsAreTurnedAndBack) {
    SdfDice dice;
    SdfSolid solid = plainSolid(kSdfBox, vec3(1.0f));
    solid.rotation = {0, std::sqrt(0.5f), 0, std::sqrt(0.5f)};  // its x axis is the world's -z
    EXPECT_LT(length(sdfToWorld(solid, {1, 0, 0}) - vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(length(sdfToLocal(solid, {0, 0, -1}) - vec3(1, 0, 0)), 1e-6f);
    solid.rotation = dice.rotation();
    const vec3 way(1, 2, -3);
    EXPECT_LT(length(sdfToWorld(solid, sdfToLocal(solid, way)) - way), 1e-5f);
    solid.rotation = {0, 0, 0, 1};
    EXPECT_EQ(sdfToLocal(solid, way), way);
    EXPECT_EQ(sdfToWorld(solid, way), way);
}

TEST(SdfPrimitive, centresHaveAUnitGradient) {
    for (const uint shape : kSdfShapes) {
        const SdfSolid solid = plainSolid(shape, {0.5f, 0.5f, 0.5f}, 0.5f);
        EXPECT_NEAR(length(sdfGradient(solid, vec3(0.0f))), 1, 1e-6) << shape;
        EXPECT_NEAR(length(sdfSurfaceNormal(solid, vec3(0.0f))), 1, 1e-6) << shape;
        EXPECT_NEAR(sdfDistance(solid, vec3(0.0f)), shape == kSdfPlane ? 0 : -0.5, 1e-6) << shape;
    }
}

}  // namespace
}  // namespace probegi::kernels
