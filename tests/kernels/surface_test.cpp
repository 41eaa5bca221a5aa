#include "kernels/shade/surface.h"

#include <gtest/gtest.h>

#include <limits>

namespace probegi::kernels {
namespace {

const vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

void expectNear(vec3 value, vec3 truth) {
    EXPECT_NEAR(length(value - truth), 0, 1e-6) << value.x << ' ' << value.y << ' ' << value.z;
}

TEST(Surface, unitOrHasLengthOneOrFallsBack) {
    expectNear(unitOr({3, 0, 4}, kX), {0.6f, 0, 0.8f});
    expectNear(unitOr({3e-14f, 0, 4e-14f}, kX), {0.6f, 0, 0.8f});
    for (const vec3 none :
         {vec3(0.0f), vec3(1e-16f, 0, 0), vec3(0, 2e15f, 0), vec3(0, 0, std::numeric_limits<float>::quiet_NaN())})
        EXPECT_EQ(unitOr(none, kY), kY);
}

TEST(Surface, interpolationHasTheCornersWeights) {
    const vec2 weights(0.25f, 0.5f);
    EXPECT_EQ(interpolate(vec2(4, 0), vec2(8, 4), vec2(16, 2), weights), vec2(11, 2));
    EXPECT_EQ(interpolate(vec3(4, 0, 8), vec3(8, 4, 0), vec3(16, 2, 0), weights), vec3(11, 2, 2));
    EXPECT_EQ(interpolate(vec4(4, 0, 8, 1), vec4(8, 4, 0, 1), vec4(16, 2, 0, 1), weights), vec4(11, 2, 2, 1));
}

// Along the tangent u grows and v is constant; the bitangent, cross(normal, tangent) w, points towards smaller v (up in
// the image).
TEST(Surface, tangentsFollowTheTexture) {
    struct Case {
        vec2 uvEdge1, uvEdge2;
        vec3 along;
        float side;
    };
    const vec3 edge1 = 2.0f * kX, edge2 = 3.0f * kY;
    for (const Case& c :
         {Case{{1, 0}, {0, -1}, kX, 1}, Case{{-1, 0}, {0, -1}, -kX, -1}, Case{{1, 0}, {0, 1}, kX, -1},
          Case{{0, -1}, {1, 0}, kY, -1}, Case{{1, 1}, {0, -1}, edge1 + edge2, 1}, Case{{1, 0}, {1, -1}, kX, 1}}) {
        const vec4 t = tangentFromUvs(edge1, edge2, c.uvEdge1, c.uvEdge2);
        expectNear(unitOr({t.x, t.y, t.z}, kZ), unitOr(c.along, kZ));
        EXPECT_EQ(t.w, c.side);
    }
    const vec4 none = tangentFromUvs(edge1, edge2, {0, 0}, {0, 0});
    EXPECT_EQ(vec3(none.x, none.y, none.z), vec3(0.0f));
}

TEST(Surface, normalMapsTurnTheNormalInItsFrame) {
    const vec4 tangent(5, 0, 7, 1);  // neither unit nor perpendicular to the normal
    expectNear(mapNormal({0.5f, 0.5f, 1}, 1, tangent, kZ), kZ);
    expectNear(mapNormal({1, 0.5f, 0.5f}, 1, tangent, kZ), kX);
    expectNear(mapNormal({0.5f, 1, 0.5f}, 1, tangent, kZ), kY);
    expectNear(mapNormal({0.5f, 1, 0.5f}, 1, vec4(5, 0, 7, -1), kZ), -kY);
    expectNear(mapNormal({1, 0, 1}, 1, tangent, kZ), normalize(vec3(1, -1, 1)));
    expectNear(mapNormal({1, 0, 1}, 0.5f, tangent, kZ), normalize(vec3(0.5f, -0.5f, 1)));
    expectNear(mapNormal({1, 0.5f, 1}, 1, vec4(0.0f), kZ), kZ);
    expectNear(mapNormal({0.5f, 0.5f, 0.5f}, 1, tangent, kZ), kZ);
}

TEST(Surface, bentNormalsFaceTheOriginByALittle) {
    EXPECT_EQ(bendTowards({0.6f, 0, 0.8f}, kZ), vec3(0.6f, 0, 0.8f));
    EXPECT_NEAR(dot(bendTowards(kX, kZ), kZ), kLeastCosine, 1e-6);
    expectNear(bendTowards({0.6f, 0, -0.8f}, kZ), normalize(vec3(0.6f, 0, kLeastCosine)));
    expectNear(bendTowards(-kZ, kZ), kZ);
}

TEST(Surface, placedPointsAreMovedAsWell) {
    EXPECT_EQ(placePoint(mat4x3(2.0f * kY, 3.0f * kX, kZ, vec3(10, 20, 30)), {1, 2, 4}), vec3(16, 22, 34));
}

TEST(Surface, placedNormalsKeepTheirDirectionOnly) {
    const mat3 stretch(2.0f * kX, kY, kZ);
    expectNear(placeNormal(stretch, {0, 0, 5}), kZ);
    expectNear(placeNormal(stretch, {3, 0, 0}), 2.0f * kX);
    EXPECT_EQ(placeNormal(stretch, vec3(0.0f)), vec3(0.0f));
}

TEST(Surface, mirroredPlacementsChangeTheBitangentsSide) {
    EXPECT_EQ(placeTangent(mat3(2.0f * kX, 3.0f * kY, 4.0f * kZ), {1, 1, 1, -1}), vec4(2, 3, 4, -1));
    EXPECT_EQ(placeTangent(mat3(-kX, kY, kZ), {1, 0, 0, 1}), vec4(-1, 0, 0, -1));
    EXPECT_EQ(placeTangent(mat3(kY, kX, kZ), {1, 0, 0, 1}), vec4(0, 1, 0, -1));
}

TEST(Surface, theWindingDecidesWhichSideIsTheFront) {
    const float r = std::sqrt(0.5f);
    const FrontNormals with = frontNormals({0, 0, 4}, {0, 2, 2}, -kX);
    expectNear(with.geometric, kZ);
    expectNear(with.shading, {0, r, r});
    expectNear(frontNormals({0, 0, 4}, {0, 2, -2}, -kX).shading, {0, -r, r});
    expectNear(frontNormals({0, 0, 4}, vec3(0.0f), -kX).shading, kZ);
    expectNear(frontNormals(vec3(0.0f), vec3(0.0f), -kX).geometric, -kX);
    EXPECT_TRUE(meetsBack(with, kZ));
    EXPECT_FALSE(meetsBack(with, -kZ));
    EXPECT_FALSE(meetsBack(with, kX)) << "grazing";
}

TEST(Surface, normalsTurnToTheRaysSide) {
    const FrontNormals n{kZ, {0, 0.6f, 0.8f}};
    const FrontNormals front = facingNormals(n, -kZ), back = facingNormals(n, kZ);
    EXPECT_EQ(front.geometric, kZ);
    EXPECT_EQ(front.shading, n.shading);
    EXPECT_EQ(back.geometric, -kZ);
    EXPECT_EQ(back.shading, -n.shading);
    // In front of the triangle but behind the shading normal, which is bent to just above grazing.
    const vec3 direction = normalize(vec3(0, 0.9f, -0.1f));
    const vec3 bent = facingNormals(n, direction).shading;
    EXPECT_GT(dot(bent, -direction), 0.9f * kLeastCosine);
    EXPECT_LT(dot(bent, -direction), 3.0f * kLeastCosine);
}

TEST(Surface, texelsMultiplyTheFactors) {
    EXPECT_EQ(surfaceAlbedo({0.5f, 2, -1}, {0.5f, 0.75f, 1}), vec3(0.25f, 1, 0));
    EXPECT_EQ(surfaceRoughness(0.5f, {1, 0.25f, 0.75f}), 0.125f);
    EXPECT_EQ(surfaceMetallic(0.5f, {1, 0.25f, 0.75f}), 0.375f);
}

}  // namespace
}  // namespace probegi::kernels
