// The shader's view of a packed scene against the C++ look-ups, on random hits.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "geometry/lighting.h"
#include "geometry/surface_shader.h"
#include "scene/sky_radiance.h"
#include "tracer/tracer_scene.h"
#include "vulkan/scene/scene_data.h"
#include "vulkan_scene/address_runner.h"
#include "vulkan_scene/shaders/question.h"

namespace probegi::test {

namespace {

using kernels::Answer;
using kernels::Question;

constexpr std::size_t kQuestions = 20000;
constexpr float kTolerance = 1e-4f;

static_assert(sizeof(Question) == 36 && sizeof(Answer) == 136 && sizeof(kernels::Push) == 28);

std::vector<std::uint8_t> noise(int width, int height, std::mt19937& random, int leastBlue = 0) {
    std::vector<std::uint8_t> rgba(std::size_t(4 * width * height));
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        const auto value = std::uint8_t(random() >> 24);
        rgba[i] = i % 4 == 2 ? std::max(value, std::uint8_t(leastBlue)) : value;
    }
    return rgba;
}

/// A texture with a random uv transform, and with wraps, filter and uv set chosen by `variant`.
TextureRef randomRef(int image, int variant, std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(-2.0f, 2.0f);
    TextureRef ref;
    ref.image = image;
    ref.texCoord = variant % 2;
    ref.wrapU = Wrap(variant % 3);
    ref.wrapV = Wrap((variant / 3) % 3);
    ref.nearest = variant % 5 == 4;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 2; ++row) ref.uvTransform[column][row] = uniform(random);
    return ref;
}

Material randomMaterial(TestScene& s, int variant, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const auto image = [&](int leastBlue) {
        const int width = 1 + int(random() % 7), height = 1 + int(random() % 7);
        return s.addImage(width, height, noise(width, height, random, leastBlue));
    };
    Material m;
    m.baseColor = {unit(random), unit(random), unit(random), 0.9f};
    m.metallic = unit(random);
    m.roughness = unit(random);
    m.emission = glm::vec3(unit(random), unit(random), variant % 4 == 0 ? 3.0f : 0.0f);
    m.normalScale = 0.5f + 0.5f * unit(random);
    m.doubleSided = variant % 3 == 0;
    m.alphaMode = variant % 2 == 0 ? AlphaMode::opaque : AlphaMode::mask;
    if (variant % 7 != 6) m.baseColorTexture = randomRef(image(0), variant, random);
    if (variant % 5 != 3) m.metallicRoughnessTexture = randomRef(image(0), variant + 1, random);
    if (variant % 4 != 2) m.normalTexture = randomRef(image(200), variant + 2, random);
    if (variant % 3 != 1) m.emissiveTexture = randomRef(image(0), variant + 3, random);
    return m;
}

/// A few large triangles with normals tilted by up to half a radian; every third mesh has no normals, every second one
/// has tangents.
Primitive randomPrimitive(int material, std::mt19937& random) {
    Primitive p;
    p.material = material;
    for (std::uint32_t t = 0; t < 12; ++t) {
        const glm::vec3 base = randomPoint(random, 4.0f), along = randomDirection(random);
        const glm::vec3 across = glm::normalize(glm::cross(along, randomDirection(random)));
        const glm::vec3 normal = glm::cross(along, across);
        for (const glm::vec3& offset : {glm::vec3(0), along, across}) {
            p.positions.push_back(base + offset);
            const glm::vec3 uv = randomPoint(random, 1.0f), uv1 = randomPoint(random, 1.0f);
            p.uv0.emplace_back(uv.x, uv.y);
            if (material % 4 != 1) p.uv1.emplace_back(uv1.x, uv1.y);
            if (material % 3 != 0) p.normals.push_back(glm::normalize(normal + randomPoint(random, 0.25f)));
            if (material % 2 == 0) p.tangents.emplace_back(along, material % 4 == 0 ? 1.0f : -1.0f);
            p.indices.push_back(std::uint32_t(p.indices.size()));
        }
    }
    return p;
}

TestScene randomScene() {
    std::mt19937 random(7);
    TestScene s;
    for (int variant = 0; variant < 24; ++variant) {
        const int material = s.addMaterial(randomMaterial(s, variant, random));
        const int mesh = s.addMesh(randomPrimitive(material, random));
        const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), float(variant), randomDirection(random));
        s.place(mesh, turned);
        if (variant % 3 == 0) continue;  // once: merged
        s.place(mesh, glm::scale(glm::translate(turned, randomPoint(random, 5.0f)), {-1.5f, 0.5f, 1.0f}));
        s.place(mesh, glm::scale(turned, {1.0f, 2.0f, 0.7f}));
    }
    return s;
}

Lighting someLighting() {
    Lighting lighting;
    lighting.lights = {{LightType::directional, {}, glm::normalize(glm::vec3(1, -2, 3)), {5, 4, 3}, 0, 1, 0},
                       {LightType::point, {1, 20, 3}, {}, {50, 40, 30}, 40.0f, 1, 0},
                       {LightType::spot, {-20, 3, 1}, {1, 0, 0}, {500, 40, 30}, 0.0f, 0.95f, 0.2f}};
    lighting.sky.radiance = {1.0f, 0.5f, 2.0f};
    lighting.sky.image = HdrImage(8, 4);
    std::mt19937 random(3);
    for (glm::vec3& pixel : lighting.sky.image.pixels) pixel = glm::vec3(2.0f) + randomPoint(random, 1.0f);
    return lighting;
}

/// The C++ results for a query.
struct CppSide {
    const SceneGeometry& geometry;
    const SurfaceMesh& mesh(const Question& q) const {
        const SurfaceGroup& group =
            q.instance < 0 ? geometry.world : geometry.group(geometry.placements[std::size_t(q.instance)]);
        return group.mesh(q.geometry);
    }
    Surface surface(const Question& q) const {
        const Hit hit{1.0f, q.primitive, q.geometry, q.instance, q.barycentric};
        if (q.instance < 0) return shadeHit(mesh(q), geometry.materials, hit, q.direction, q.spread);
        const Placement& p = geometry.placements[std::size_t(q.instance)];
        return shadeHit(mesh(q), geometry.materials, hit, q.direction, p.toWorld, p.normalToWorld, q.spread);
    }
    /// The texture's alpha minus the cutoff.
    float alphaMargin(const Question& q) const {
        const SurfaceTriangle& triangle = mesh(q).triangles[std::size_t(q.primitive)];
        const SurfaceMaterial& material = geometry.materials[triangle.material];
        const TextureSampler& texture = material.baseColorTexture;
        return texture.alpha(interpolateUv(mesh(q), triangle, q.barycentric, texture.texCoord())) -
               material.textureAlphaCutoff;
    }
};

/// Hits spread over all meshes. Rays that graze their triangle are left out: rounding decides which side they hit.
std::vector<Question> randomQuestions(const SceneGeometry& geometry) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const CppSide cpp{geometry};
    std::vector<Question> questions;
    while (questions.size() < kQuestions) {
        Question q;
        q.instance = int(random() % (geometry.placements.size() + 1)) - 1;
        q.geometry = int(random() % 2);
        const std::size_t triangles = cpp.mesh(q).triangles.size();
        if (triangles == 0) continue;
        q.primitive = int(random() % triangles);
        q.direction = randomDirection(random);
        q.spread = questions.size() % 2 == 0 ? 0.0f : 0.3f * unit(random);
        const float u = unit(random), v = unit(random);
        q.barycentric = u + v < 1.0f ? glm::vec2(u, v) : glm::vec2(1.0f - u, 1.0f - v);
        if (glm::dot(cpp.surface(q).geometricNormal, q.direction) < -0.02f) questions.push_back(q);
    }
    return questions;
}

std::vector<std::uint32_t> readSpirv() {
    std::ifstream file(PROBEGI_SCENE_SPIRV, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::copy_n(bytes.data(), words.size() * 4, reinterpret_cast<char*>(words.data()));
    return words;
}

kernels::SceneAddresses upload(AddressRunner& runner, const vulkan::SceneData& data, const Lighting& lighting) {
    const auto put = [&](const auto& values) { return vulkan::packAddress(runner.upload(values)); };
    kernels::SceneAddresses a{};
    a.vertices = put(data.vertices);
    a.triangles = put(data.triangles);
    a.uv1 = put(data.uv1);
    a.tangents = put(data.tangents);
    a.meshes = put(data.meshes);
    a.instances = put(data.instances);
    a.materials = put(data.materials);
    a.textures = put(data.textures);
    a.texels = put(data.texels);
    a.srgbTable = put(data.srgbTable);
    a.lights = put(vulkan::packLights(lighting.lights));
    a.skyPixels = put(lighting.sky.image.pixels);
    a.sky = vulkan::packSky(lighting.sky);
    a.lightCount = int(lighting.lights.size());
    return a;
}

std::vector<Answer> ask(AddressRunner& runner, const kernels::SceneAddresses& scene,
                        const std::vector<Question>& questions) {
    std::vector<Answer> answers(questions.size());
    const std::uint64_t out = runner.upload(answers);
    const kernels::Push push{vulkan::packAddress(runner.upload(std::span(&scene, 1))),
                             vulkan::packAddress(runner.upload(questions)), vulkan::packAddress(out),
                             std::uint32_t(questions.size())};
    runner.run(readSpirv(), std::as_bytes(std::span(&push, 1)), int((questions.size() + 63) / 64));
    runner.download(out, std::span(answers));
    return answers;
}

/// Expects a small difference relative to the larger of 1 and the value.
void expectClose(glm::vec3 actual, glm::vec3 expected, const char* what) {
    EXPECT_LE(glm::distance(actual, expected), kTolerance * std::max(1.0f, glm::length(expected))) << what;
}

void expectSame(const Answer& a, const Surface& s) {
    expectClose(a.position, s.position, "position");
    expectClose(a.geometricNormal, s.geometricNormal, "geometric normal");
    expectClose(a.shadingNormal, s.shadingNormal, "shading normal");
    expectClose(a.albedo, s.albedo, "albedo");
    expectClose(a.emission, s.emission, "emission");
    EXPECT_NEAR(a.metallic, s.metallic, kTolerance);
    EXPECT_NEAR(a.roughness, s.roughness, kTolerance);
    EXPECT_EQ(a.material, s.material);
    EXPECT_EQ(a.back != 0, s.back);
    EXPECT_EQ(a.backface != 0, s.backface);
}

/// The shader's results on the random scene, from one dispatch for all tests.
struct Asked {
    TestScene scene = randomScene();
    Lighting lighting = someLighting();
    Context context = Context::create().value();
    MipMaps mips{context, scene.scene};
    SceneGeometry geometry = SceneGeometry::gather(scene.scene, scene.pose);
    std::vector<Question> questions = randomQuestions(geometry);
    float magnitude = sceneMagnitude(geometry.bounds());
    std::vector<Answer> answers;

    Asked() {
        geometry.materials = makeSurfaceMaterials(scene.scene, mips);
        EXPECT_TRUE(validate(scene.scene));
        auto runner = AddressRunner::create();
        if (!runner) {
            ADD_FAILURE() << runner.error().message;
            return;
        }
        kernels::SceneAddresses addresses = upload(
            *runner, vulkan::packScene(geometry, EmitterGeometry(scene.scene, scene.pose).placed(), scene.scene, mips),
            lighting);
        addresses.magnitude = magnitude;
        answers = ask(*runner, addresses, questions);
    }
};

const Asked& asked() {
    static const Asked all;
    return all;
}

}  // namespace

TEST(SceneShader, SurfacesAreThoseOfCpp) {
    ASSERT_EQ(asked().answers.size(), kQuestions);
    const CppSide cpp{asked().geometry};
    int backfaces = 0;
    for (std::size_t i = 0; i < kQuestions && !HasFailure(); ++i) {
        SCOPED_TRACE(i);
        const Surface expected = cpp.surface(asked().questions[i]);
        expectSame(asked().answers[i], expected);
        backfaces += expected.backface ? 1 : 0;
    }
    EXPECT_GT(backfaces, int(kQuestions / 10));
    EXPECT_LT(backfaces, int(kQuestions / 2));
}

TEST(SceneShader, MaskedCandidatesPassWhereTheirAlphaReachesTheCutoff) {
    ASSERT_EQ(asked().answers.size(), kQuestions);
    const CppSide cpp{asked().geometry};
    int passed = 0, rejected = 0;
    for (std::size_t i = 0; i < kQuestions && !HasFailure(); ++i) {
        SCOPED_TRACE(i);
        const Question& q = asked().questions[i];
        const bool passes = asked().answers[i].passes != 0;
        if (q.geometry == SurfaceGroup::kOpaque) {
            EXPECT_TRUE(passes);
            continue;
        }
        const float margin = cpp.alphaMargin(q);
        (margin >= 0.0f ? passed : rejected) += 1;
        // Within the tolerance, rounding decides.
        EXPECT_TRUE(passes == (margin >= 0.0f) || std::abs(margin) < kTolerance) << margin;
    }
    EXPECT_GT(passed, 1000);
    EXPECT_GT(rejected, 1000);
}

TEST(SceneShader, SkyAndLightsAreThoseOfCpp) {
    ASSERT_EQ(asked().answers.size(), kQuestions);
    const Lighting& lighting = asked().lighting;
    for (std::size_t i = 0; i < kQuestions && !HasFailure(); ++i) {
        SCOPED_TRACE(i);
        const Answer& a = asked().answers[i];
        expectClose(a.sky, skyRadiance(lighting.sky, asked().questions[i].direction), "sky");
        const kernels::LightSample light = sampleLight(lighting.lights[i % lighting.lights.size()], a.position);
        expectClose(a.toLight, light.toLight, "direction to the light");
        expectClose(a.irradianceAtNormal, light.irradianceAtNormal, "irradiance");
        const Ray shadow = shadowRay(a.position, a.geometricNormal, light, asked().magnitude);
        expectClose(a.shadowOrigin, shadow.origin, "shadow ray's origin");
        EXPECT_GT(glm::dot(a.shadowOrigin - a.position, a.geometricNormal), 0.0f);
        EXPECT_NEAR(a.shadowEnd / shadow.far, 1.0f, kTolerance);
    }
}

}  // namespace probegi::test
