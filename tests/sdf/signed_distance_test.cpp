#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "probegi/sdf.h"
#include "sdf/solid.h"

namespace probegi {
namespace {

SdfPrimitive sphere(glm::vec3 centre, float radius) {
    SdfPrimitive primitive;
    primitive.shape = SdfShape::sphere;
    primitive.centre = centre;
    primitive.halfSize.x = radius;
    return primitive;
}

TEST(SignedDistance, isThatToTheNearestSolid) {
    const SdfScene sdf{{sphere({0, 0, 0}, 1), sphere({5, 0, 0}, 2)}};
    EXPECT_FLOAT_EQ(signedDistance(sdf, {-3, 0, 0}), 2);
    EXPECT_FLOAT_EQ(signedDistance(sdf, {2.5f, 0, 0}), 0.5f);
    EXPECT_FLOAT_EQ(signedDistance(sdf, {4, 0, 0}), -1);
    EXPECT_EQ(signedDistance(SdfScene{}, {4, 0, 0}), 1e30f);
}

// A quarter about z, twice the size, moved by 10 along x.
TEST(MakeSolid, ridesOnAFrame) {
    const glm::mat4 frame = glm::translate(glm::mat4(1), {10, 0, 0}) *
                            glm::rotate(glm::mat4(1), 1.57079633f, {0, 0, 1}) * glm::scale(glm::mat4(1), glm::vec3(2));
    SdfPrimitive primitive;
    primitive.shape = SdfShape::roundedBox;
    primitive.centre = {1, 0, 0};
    primitive.halfSize = {0.5f, 1, 1.5f};
    primitive.rounding = 0.25f;
    const auto at = [](const kernels::SdfSolid& solid, glm::vec3 point) { return kernels::sdfDistance(solid, point); };
    const kernels::SdfSolid solid = makeSolid(primitive, frame);
    EXPECT_NEAR(solid.rounding, 0.5f, 1e-6);
    EXPECT_NEAR(at(solid, {10, 2, 0}), -1, 1e-5);
    EXPECT_NEAR(at(solid, {10, 4, 0}), 1, 1e-5);
    EXPECT_NEAR(at(solid, {13, 2, 0}), 1, 1e-5);
    EXPECT_NEAR(at(solid, {10, 2, -4}), 1, 1e-5);
    // A mirrored frame too: shapes are symmetric.
    const kernels::SdfSolid mirrored = makeSolid(primitive, frame * glm::scale(glm::mat4(1), {1, 1, -1}));
    for (const glm::vec3 point : {glm::vec3(10, 4, 3), glm::vec3(8, 1, -4), glm::vec3(11, 2, 0.5f)}) {
        EXPECT_NEAR(at(mirrored, point), at(solid, point), 1e-5);
    }
    SdfPrimitive ground;
    ground.shape = SdfShape::plane;
    const kernels::SdfSolid ceiling = makeSolid(ground, glm::scale(glm::mat4(1), {1, -1, 1}));
    EXPECT_NEAR(at(ceiling, {3, 2, 1}), -2, 1e-6);
}

// A whole Sponza in at most 4 KB (section 3.1).
TEST(MakeSolid, manyFitIntoLittleMemory) {
    EXPECT_LE(64 * sizeof(kernels::SdfSolid), 3072u);
}

}  // namespace
}  // namespace probegi
