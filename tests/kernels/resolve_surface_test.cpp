#include "kernels/shade/resolve_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace probegi::kernels {
namespace {

struct TestSurface {
    vec3 position, geometricNormal, shadingNormal, albedo, emission;
    float metallic, roughness;
    int material;
    bool back, backface;
};

/// Texels that say which look-up made them; present if `levels` is.
struct TestTexture {
    int levels = 0;
    int uvSet = 0;
    float density = 1;
    vec3 data{0.0f};
};

struct TestMaterial {
    vec3 baseColor{1.0f};
    float metallic = 1;
    vec3 emission{0.0f};
    float roughness = 1;
    float normalScale = 1;
    bool doubleSided = false;
    TestTexture baseColorTexture, metallicRoughnessTexture, normalTexture, emissiveTexture;
};

/// A right-angled triangle in the plane z = 0, with its front above.
struct TestHit {
    using Surface = TestSurface;
    using SurfaceTexture = TestTexture;

    vec2 barycentric{0.25f, 0.5f};
    bool placed = false;
    mat4x3 toWorld{1.0f};
    mat3 normalToWorld{1.0f};
    int materialIndex = 3;
    TestMaterial material;
    vec3 normals[3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    std::vector<vec4> tangents;
};

vec3 cornerPosition(const TestHit&, int corner) {
    return corner == 0 ? vec3(1, 1, 0) : (corner == 1 ? vec3(5, 1, 0) : vec3(1, 3, 0));
}
vec3 cornerNormal(const TestHit& hit, int corner) {
    return hit.normals[corner];
}
// The first set goes along x and y, the second four times as fast and the other way around.
vec2 cornerUv(const TestHit&, int corner, int uvSet) {
    const vec2 uv = corner == 0 ? vec2(0, 0) : (corner == 1 ? vec2(1, 0) : vec2(0, 0.5f));
    return uvSet == 0 ? uv : vec2(4 * uv.y, 4 * uv.x);
}
bool hasTangents(const TestHit& hit) {
    return !hit.tangents.empty();
}
vec4 cornerTangent(const TestHit& hit, int corner) {
    return hit.tangents[std::size_t(corner)];
}
bool isTexture(const TestHit&, const TestTexture& texture) {
    return texture.levels > 0;
}
const TestTexture& openTexture(const TestHit&, const TestTexture& texture) {
    return texture;
}
int textureUvSet(const TestHit&, const TestTexture& texture) {
    return texture.uvSet;
}
int textureLevels(const TestHit&, const TestTexture& texture) {
    return texture.levels;
}
float textureDensity(const TestHit&, const TestTexture& texture) {
    return texture.density;
}
vec3 textureColor(const TestHit&, const TestTexture&, vec2 uv, float level) {
    return {uv.x, uv.y, level / 8};
}
vec3 textureData(const TestHit&, const TestTexture& texture, vec2, float) {
    return texture.data;
}

constexpr vec3 kDown(0, 0, -1), kUp(0, 0, 1);

TestSurface resolve(const TestHit& hit, vec3 direction = kDown, float spread = 0) {
    return resolveSurface(hit, direction, 2.0f, spread);
}

void expectNear(vec3 a, vec3 b) {
    EXPECT_NEAR(length(a - b), 0, 1e-6f) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(ResolveSurface, frontsFaceTheRay) {
    const TestSurface s = resolve({});
    EXPECT_EQ(s.position, vec3(2, 2, 0));
    EXPECT_EQ(s.geometricNormal, kUp);
    EXPECT_EQ(s.shadingNormal, kUp);
    EXPECT_EQ(s.material, 3);
    EXPECT_FALSE(s.back);
    EXPECT_FALSE(s.backface);
}

TEST(ResolveSurface, cornersNormalsAreInterpolated) {
    TestHit hit;
    hit.normals[0] = hit.normals[1] = {0, 0, 1};
    hit.normals[2] = {1, 0, 0};
    expectNear(resolve(hit).shadingNormal, {std::sqrt(0.5f), 0, std::sqrt(0.5f)});
    EXPECT_EQ(resolve(hit).geometricNormal, kUp);
}

TEST(ResolveSurface, backsAreWallsUnlessTheMaterialHasTwoSides) {
    TestHit hit;
    hit.material.emission = vec3(2.0f);
    const TestSurface wall = resolve(hit, kUp);
    EXPECT_EQ(wall.geometricNormal, kDown);
    EXPECT_TRUE(wall.back);
    EXPECT_TRUE(wall.backface);
    EXPECT_EQ(wall.albedo, vec3(0.0f));
    EXPECT_EQ(wall.emission, vec3(0.0f));
    hit.material.doubleSided = true;
    const TestSurface leaf = resolve(hit, kUp);
    EXPECT_TRUE(leaf.back);
    EXPECT_FALSE(leaf.backface);
    EXPECT_EQ(leaf.albedo, vec3(1.0f));
    EXPECT_EQ(leaf.emission, vec3(2.0f));
}

TEST(ResolveSurface, placementsMoveTurnAndStretch) {
    TestHit hit;
    hit.placed = true;
    hit.toWorld = mat4x3(vec3(0, 0, -2), vec3(0, 1, 0), vec3(1, 0, 0), vec3(10, 20, 30));
    hit.normalToWorld = mat3(vec3(0, 0, -1), vec3(0, 2, 0), vec3(2, 0, 0));
    const TestSurface s = resolve(hit, {-1, 0, 0});
    EXPECT_EQ(s.position, vec3(10, 22, 26));
    expectNear(s.geometricNormal, {1, 0, 0});
    expectNear(s.shadingNormal, {1, 0, 0});
    hit.placed = false;
    EXPECT_EQ(resolve(hit).position, vec3(2, 2, 0)) << "matrices of what is not placed do not count";
}

TEST(ResolveSurface, texturesMultiplyTheMaterial) {
    TestHit hit;
    hit.material.baseColor = {0.5f, 1, 1};
    hit.material.metallic = 0.5f;
    hit.material.roughness = 0.25f;
    hit.material.emission = {8, 0, 2};
    EXPECT_EQ(resolve(hit).albedo, vec3(0.5f, 1, 1));
    EXPECT_EQ(resolve(hit).metallic, 0.5f);
    EXPECT_EQ(resolve(hit).emission, vec3(8, 0, 2));
    hit.material.baseColorTexture = {.levels = 1};
    hit.material.metallicRoughnessTexture = {.levels = 1, .data = {0.9f, 0.5f, 0.25f}};
    hit.material.emissiveTexture = {.levels = 1, .uvSet = 1};
    const TestSurface s = resolve(hit);
    EXPECT_EQ(s.albedo, vec3(0.125f, 0.25f, 0)) << "at the uv (1/4, 1/4)";
    EXPECT_EQ(s.metallic, 0.125f);
    EXPECT_EQ(s.roughness, 0.125f);
    EXPECT_EQ(s.emission, vec3(8, 0, 0)) << "at the uv (1, 1)";
    hit.material.emission = {0, -1, std::nanf("")};
    EXPECT_EQ(resolve(hit).emission, vec3(0.0f));
}

// Twice its area is 8, and 1/2 of uv: at 256 texels a unit of uv, a metre is 4 texels wide.
TEST(ResolveSurface, conesChooseTheMipLevel) {
    TestHit hit;
    hit.material.baseColorTexture = {.levels = 9, .density = 256};
    const auto level = [&](float spread) { return 8 * resolve(hit, kDown, spread).albedo.z; };
    EXPECT_EQ(level(0), 0.0f);
    EXPECT_FLOAT_EQ(level(0.5f), 2.0f) << "a metre after two";
    EXPECT_FLOAT_EQ(level(1), 3.0f);
    hit.placed = true;
    hit.toWorld = mat4x3(vec3(4, 0, 0), vec3(0, 4, 0), vec3(0, 0, 4), vec3(0.0f));
    EXPECT_FLOAT_EQ(level(1), 1.0f) << "texels four times as large";
    hit.placed = false;
    hit.material.baseColorTexture.uvSet = 1;
    EXPECT_FLOAT_EQ(level(0.5f), 4.0f) << "four times as small";
    hit.material.baseColorTexture.levels = 1;
    EXPECT_EQ(level(1), 0.0f);
}

// The texel leans along the tangent alone.
TEST(ResolveSurface, normalMapsFollowTheTangent) {
    const float r = std::sqrt(0.5f);
    TestHit hit;
    hit.material.normalTexture = {.levels = 1, .data = {1, 0.5f, 1}};
    expectNear(resolve(hit).shadingNormal, {r, 0, r});
    EXPECT_EQ(resolve(hit).geometricNormal, kUp);
    hit.material.normalTexture.uvSet = 1;
    expectNear(resolve(hit).shadingNormal, {0, r, r});
    hit.tangents = {{-1, 0, 0, 1}, {-1, 0, 0, 1}, {-1, 0, 0, 1}};
    expectNear(resolve(hit).shadingNormal, {-r, 0, r});
    hit.tangents.assign(3, vec4(0.0f));
    expectNear(resolve(hit).shadingNormal, {0, r, r});
    hit.placed = true;
    hit.toWorld = mat4x3(vec3(0, 1, 0), vec3(-1, 0, 0), vec3(0, 0, 1), vec3(0.0f));
    hit.normalToWorld = mat3(hit.toWorld);
    expectNear(resolve(hit).shadingNormal, {-r, 0, r});
    hit.material.normalScale = 0;
    EXPECT_EQ(resolve(hit).shadingNormal, kUp);
}

}  // namespace
}  // namespace probegi::kernels
