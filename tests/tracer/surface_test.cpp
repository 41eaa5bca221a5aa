// Surfaces at hits: sides, normals, normal maps and material textures.
#include <cmath>
#include <limits>

#include "tracer/tracer_scene.h"

namespace probegi::test {

namespace {

const Ray kDown = rayAlong({0.2f, 1, 0.3f}, {0, -1, 0});
const Ray kUp = rayAlong({0.2f, -1, 0.3f}, {0, 1, 0});

Material glowing() {
    Material m;
    m.baseColor = {0.25f, 0.5f, 0.75f, 1.0f};
    m.emission = {3, 2, 1};
    m.metallic = 0.125f;
    m.roughness = 0.375f;
    return m;
}

std::vector<std::uint8_t> uniform(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    return {r, g, b, 255};
}

/// A quad with a normal map of one code.
TestScene mappedQuad(glm::u8vec3 code, float scale = 1.0f) {
    TestScene s;
    Material m;
    m.normalTexture.image = s.addImage(1, 1, uniform(code.x, code.y, code.z));
    m.normalScale = scale;
    s.addMesh(quad(s.addMaterial(m)));
    return s;
}

/// The normal that a code encodes, in its frame.
glm::vec3 decode(glm::u8vec3 code) {
    return glm::normalize(glm::vec3(code) * (2.0f / 255.0f) - 1.0f);
}

}  // namespace

class TracerSurface : public EveryTracer {};
PROBEGI_ON_EVERY_TRACER(TracerSurface);

TEST_P(TracerSurface, FrontOfASingleSidedMaterial) {
    TestScene s;
    s.add(quad(s.addMaterial(glowing())));
    const Shot shot = shoot(*trace(GetParam(), s), kDown);
    EXPECT_FALSE(shot.surface.backface);
    EXPECT_FALSE(shot.surface.back);
    EXPECT_EQ(shot.surface.material, 1);
    EXPECT_EQ(shot.surface.albedo, glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(shot.surface.emission, glm::vec3(3, 2, 1));
    EXPECT_EQ(shot.surface.metallic, 0.125f);
    EXPECT_EQ(shot.surface.roughness, 0.375f);
    expectNear(shot.surface.position, {0.2f, 0, 0.3f}, 1e-6f);
    expectNear(shot.surface.shadingNormal, {0, 1, 0}, 1e-6f);
}

TEST_P(TracerSurface, BackOfASingleSidedMaterialIsBlack) {
    TestScene s;
    s.add(quad(s.addMaterial(glowing())));
    const Shot shot = shoot(*trace(GetParam(), s), kUp);
    ASSERT_TRUE(shot.hit.valid()) << "backs are not culled";
    EXPECT_TRUE(shot.blocked);
    EXPECT_TRUE(shot.surface.backface);
    EXPECT_TRUE(shot.surface.back);
    EXPECT_EQ(shot.surface.albedo, glm::vec3(0));
    EXPECT_EQ(shot.surface.emission, glm::vec3(0));
    expectNear(shot.surface.geometricNormal, {0, -1, 0}, 1e-6f);
    expectNear(shot.surface.shadingNormal, {0, -1, 0}, 1e-6f);
}

TEST_P(TracerSurface, DoubleSidedMaterialsHaveNoBackface) {
    TestScene s;
    Material m = glowing();
    m.doubleSided = true;
    s.add(quad(s.addMaterial(m)));
    const Shot shot = shoot(*trace(GetParam(), s), kUp);
    EXPECT_FALSE(shot.surface.backface);
    EXPECT_TRUE(shot.surface.back) << "but a winding";
    EXPECT_EQ(shot.surface.albedo, glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(shot.surface.emission, glm::vec3(3, 2, 1));
    expectNear(shot.surface.geometricNormal, {0, -1, 0}, 1e-6f);
    EXPECT_FALSE(shoot(*trace(GetParam(), s), kDown).surface.back);
}

TEST_P(TracerSurface, MirroredPlacementsKeepTheirFront) {
    const glm::mat4 mirror = glm::scale(glm::mat4(1.0f), glm::vec3(-1, 1, 1));
    for (const bool shared : {false, true}) {
        TestScene s;
        const int mesh = s.addMesh(quad());
        s.place(mesh, mirror);
        if (shared) s.place(mesh, glm::translate(mirror, glm::vec3(10, 0, 0)));
        const auto tracer = trace(GetParam(), s);
        if (GetParam().tellsInstances) {
            EXPECT_EQ(shoot(*tracer, kDown).hit.instance >= 0, shared);
        }
        EXPECT_FALSE(shoot(*tracer, kDown).surface.backface);
        EXPECT_TRUE(shoot(*tracer, kUp).surface.backface);
        expectNear(shoot(*tracer, kDown).surface.geometricNormal, {0, 1, 0}, 1e-6f);
        s.scene.materials[0].doubleSided = true;
        const auto twoSided = trace(GetParam(), s);
        EXPECT_FALSE(shoot(*twoSided, kDown).surface.back);
        EXPECT_TRUE(shoot(*twoSided, kUp).surface.back);
    }
}

TEST_P(TracerSurface, NormalsFollowNonUniformScale) {
    // The plane y = x, stretched twofold along x, becomes y = x / 2.
    Primitive slope = quad();
    for (glm::vec3& p : slope.positions) p.y = p.x;
    slope.normals.assign(4, glm::normalize(glm::vec3(-1, 1, 0)));
    const glm::mat4 stretch = glm::scale(glm::mat4(1.0f), glm::vec3(2, 1, 1));
    for (const bool shared : {false, true}) {
        TestScene s;
        const int mesh = s.addMesh(slope);
        s.place(mesh, stretch);
        if (shared) s.place(mesh, glm::translate(stretch, glm::vec3(0, 0, 10)));
        const Shot shot = shoot(*trace(GetParam(), s), rayAlong({0.5f, 5, 0}, {0, -1, 0}));
        const glm::vec3 expected = glm::normalize(glm::vec3(-1, 2, 0));
        expectNear(shot.surface.geometricNormal, expected, 1e-5f);
        expectNear(shot.surface.shadingNormal, expected, 1e-5f);
        expectNear(shot.surface.position, {0.5f, 0.25f, 0}, 1e-5f);
    }
}

TEST_P(TracerSurface, NormalsAreInterpolated) {
    Primitive p = quad();
    p.normals = {glm::normalize(glm::vec3(-1, 1, 0)), glm::normalize(glm::vec3(-1, 1, 0)),
                 glm::normalize(glm::vec3(1, 1, 0)), glm::normalize(glm::vec3(1, 1, 0))};
    TestScene s;
    s.add(p);
    const auto tracer = trace(GetParam(), s);
    expectNear(shoot(*tracer, rayAlong({0, 1, 0.1f}, {0, -1, 0})).surface.shadingNormal, {0, 1, 0}, 1e-6f);
    const glm::vec3 half = shoot(*tracer, rayAlong({0.5f, 1, 0.1f}, {0, -1, 0})).surface.shadingNormal;
    expectNear(half, glm::normalize(glm::vec3(0.5f, 1, 0)), 1e-5f);
}

TEST_P(TracerSurface, NormalsAgainstTheWindingTurnToIt) {
    Primitive p = quad();
    p.normals.assign(4, {0, -1, 0});
    TestScene s;
    s.add(p);
    const auto tracer = trace(GetParam(), s);
    EXPECT_FALSE(shoot(*tracer, kDown).surface.backface) << "the winding decides";
    expectNear(shoot(*tracer, kDown).surface.shadingNormal, {0, 1, 0}, 1e-6f);
}

TEST_P(TracerSurface, ShadingNormalsThatFaceAwayAreBent) {
    Primitive p = quad();
    p.normals.assign(4, glm::normalize(glm::vec3(1, 0.2f, 0)));
    TestScene s;
    s.add(p);
    const Ray grazing = rayAlong({-0.9f, 0.5f, 0.1f}, {1, -0.6f, 0});
    const Shot shot = shoot(*trace(GetParam(), s), grazing);
    ASSERT_TRUE(shot.hit.valid());
    const float cosine = glm::dot(shot.surface.shadingNormal, -grazing.direction);
    EXPECT_GT(cosine, 0.0f);
    EXPECT_LT(cosine, 0.01f) << "no further than needed";
    EXPECT_NEAR(glm::length(shot.surface.shadingNormal), 1.0f, 1e-5f);
    expectNear(shot.surface.geometricNormal, {0, 1, 0}, 1e-6f);
}

TEST_P(TracerSurface, NormalMapPointsAlongTheImage) {
    // Red tilts the normal towards +u, which is +x here; green towards the image's top, which is -z.
    const glm::u8vec3 code(180, 200, 230);
    const glm::vec3 n = decode(code);
    TestScene s = mappedQuad(code);
    s.place(0);
    expectNear(shoot(*trace(GetParam(), s), kDown).surface.shadingNormal, {n.x, n.z, -n.y}, 1e-5f);
    expectNear(shoot(*trace(GetParam(), s), kDown).surface.geometricNormal, {0, 1, 0}, 1e-6f);
}

TEST_P(TracerSurface, NormalMapWithTangentsOfTheFile) {
    const glm::u8vec3 code(180, 200, 230);
    const glm::vec3 n = decode(code);
    TestScene s = mappedQuad(code);
    // Tangent along +z and a flipped bitangent: n = x T + y B, B = cross(+y, +z) * -1 = -x.
    s.scene.meshes[0].primitives[0].tangents.assign(4, {0, 0, 1, -1});
    s.scene.meshes[0].primitives[0].normals.assign(4, {0, 1, 0});
    s.place(0);
    expectNear(shoot(*trace(GetParam(), s), kDown).surface.shadingNormal, {-n.y, n.z, n.x}, 1e-5f);
}

TEST_P(TracerSurface, NormalMapFollowsPlacements) {
    const glm::u8vec3 code(180, 200, 230);
    const glm::vec3 n = decode(code);
    for (const bool given : {false, true}) {
        for (const bool shared : {false, true}) {
            TestScene s = mappedQuad(code);
            if (given) s.scene.meshes[0].primitives[0].tangents.assign(4, {1, 0, 0, 1});
            if (given) s.scene.meshes[0].primitives[0].normals.assign(4, {0, 1, 0});
            const glm::mat4 mirror = glm::scale(glm::mat4(1.0f), glm::vec3(-1, 1, 1));
            s.place(0, mirror);
            if (shared) s.place(0, glm::translate(mirror, glm::vec3(10, 0, 0)));
            expectNear(shoot(*trace(GetParam(), s), kDown).surface.shadingNormal, {-n.x, n.z, -n.y}, 1e-5f);
        }
    }
}

TEST_P(TracerSurface, NormalScaleFlattens) {
    TestScene s = mappedQuad({255, 128, 128}, 0.0f);
    s.place(0);
    expectNear(shoot(*trace(GetParam(), s), kDown).surface.shadingNormal, {0, 1, 0}, 1e-6f);
}

TEST_P(TracerSurface, NormalMapWithoutUvsStaysFinite) {
    TestScene s = mappedQuad({180, 200, 230});
    s.scene.meshes[0].primitives[0].uv0.assign(4, {0.5f, 0.5f});
    s.place(0);
    const glm::vec3 normal = shoot(*trace(GetParam(), s), kDown).surface.shadingNormal;
    EXPECT_NEAR(glm::length(normal), 1.0f, 1e-5f);
    EXPECT_GT(normal.y, 0.0f);
}

TEST_P(TracerSurface, TexturesMultiplyTheFactors) {
    TestScene s;
    Material m = glowing();
    m.metallic = m.roughness = 0.5f;
    m.baseColorTexture.image = s.addImage(1, 1, uniform(188, 255, 0));
    m.metallicRoughnessTexture.image = s.addImage(1, 1, uniform(255, 51, 102));
    m.emissiveTexture.image = s.addImage(1, 1, uniform(255, 188, 0));
    s.add(quad(s.addMaterial(m)));
    const Surface surface = shoot(*trace(GetParam(), s), kDown).surface;
    expectNear(surface.albedo, {0.25f * 0.502887f, 0.5f, 0}, 1e-5f);
    EXPECT_FLOAT_EQ(surface.roughness, 0.5f * 0.2f);
    EXPECT_FLOAT_EQ(surface.metallic, 0.5f * 0.4f);
    expectNear(surface.emission, {3, 2 * 0.502887f, 0}, 1e-5f);
}

TEST_P(TracerSurface, UvIsThatOfTheHit) {
    TestScene s;
    Material m;
    m.baseColorTexture.image = s.addImage(2, 2, {0, 0, 0, 255, 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255});
    m.baseColorTexture.nearest = true;
    s.add(quad(s.addMaterial(m)));
    const auto tracer = trace(GetParam(), s);
    const auto albedo = [&](float x, float z) {
        return shoot(*tracer, rayAlong({x, 1, z}, {0, -1, 0})).surface.albedo;
    };
    EXPECT_EQ(albedo(-0.5f, -0.4f), glm::vec3(0, 0, 0));
    EXPECT_EQ(albedo(0.5f, -0.4f), glm::vec3(1, 0, 0));
    EXPECT_EQ(albedo(-0.5f, 0.4f), glm::vec3(0, 1, 0));
    EXPECT_EQ(albedo(0.5f, 0.4f), glm::vec3(0, 0, 1));
}

TEST_P(TracerSurface, SecondUvSet) {
    TestScene s;
    s.add(quad(), glm::translate(glm::mat4(1.0f), glm::vec3(5, 0, 0)));  // its vertices precede those with a second set
    Material m;
    m.baseColorTexture.image = s.addImage(2, 1, {0, 0, 0, 255, 255, 0, 0, 255});
    m.baseColorTexture.nearest = true;
    m.baseColorTexture.texCoord = 1;
    Primitive p = quad(s.addMaterial(m));
    p.uv1.assign(4, {0.75f, 0.5f});
    s.add(p);
    s.add(quad(), glm::translate(glm::mat4(1.0f), glm::vec3(-5, 0, 0)));
    EXPECT_EQ(shoot(*trace(GetParam(), s), rayAlong({-0.5f, 1, 0.1f}, {0, -1, 0})).surface.albedo, glm::vec3(1, 0, 0));
}

// A checkerboard of 64 x 64 texels on 2 x 2 m is grey over a cone that covers many of them; without a cone the result
// is that of surfaces().
TEST_P(TracerSurface, TexturesAreFilteredOverTheCone) {
    TestScene s;
    std::vector<std::uint8_t> chess;
    for (int i = 0; i < 64 * 64; ++i)
        for (int c = 0; c < 4; ++c) chess.push_back(c == 3 || ((i ^ (i / 64)) & 1) ? 255 : 0);
    Material m;
    m.baseColorTexture.image = s.addImage(64, 64, std::move(chess));
    m.baseColorTexture.nearest = true;
    s.add(quad(s.addMaterial(m)));
    const auto tracer = trace(GetParam(), s);
    for (const glm::vec3 origin : {glm::vec3(0.02f, 1, 0.01f), glm::vec3(-0.3f, 1, 0.23f)}) {
        const Ray ray = rayAlong(origin, {0, -1, 0});
        const Shot shot = shoot(*tracer, ray);
        Surface wide, sharp;
        tracer->filteredSurfaces({&ray, 1}, {&shot.hit, 1}, 0.25f, {&wide, 1}).value();
        tracer->filteredSurfaces({&ray, 1}, {&shot.hit, 1}, 0.0f, {&sharp, 1}).value();
        EXPECT_NEAR(wide.albedo.x, 0.5f, 0.005f);
        EXPECT_EQ(sharp.albedo, shot.surface.albedo);
        EXPECT_TRUE(sharp.albedo.x == 0 || sharp.albedo.x == 1);
    }
}

TEST_P(TracerSurface, MissedRaysLeaveTheirEntry) {
    TestScene s;
    s.add(quad());
    const auto tracer = trace(GetParam(), s);
    const Ray rays[2] = {rayAlong({9, 1, 9}, {0, -1, 0}), kDown};
    Hit hits[2];
    Surface surfaces[2];
    surfaces[0].position = {7, 7, 7};
    tracer->closestHits(rays, hits).value();
    tracer->surfaces(rays, hits, surfaces).value();
    EXPECT_EQ(surfaces[0].position, glm::vec3(7));
    EXPECT_EQ(surfaces[1].position.y, 0.0f);
}

}  // namespace probegi::test
