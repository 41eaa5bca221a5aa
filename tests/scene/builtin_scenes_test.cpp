#include "probegi/builtin_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <set>

#include "probegi/tracer.h"
#include "scene/mesh_checks.h"

namespace probegi {
namespace {

using ::testing::HasSubstr;

struct BuiltTracer {
    Scene scene;
    ScenePose pose;
    std::unique_ptr<Tracer> tracer;
};

/// On the heap, since the tracer refers to the scene.
std::unique_ptr<BuiltTracer> build(std::string_view name, const BuiltinParams& params = {}) {
    auto built = std::make_unique<BuiltTracer>();
    built->scene = makeBuiltinScene(name, params).value();
    built->pose = poseAt(built->scene);
    built->tracer = makeEmbreeTracer(Context::create().value(), built->scene, built->pose).value();
    return built;
}

/// Evenly spread unit vectors (spherical Fibonacci lattice).
std::vector<Ray> raysAround(glm::vec3 origin, int count) {
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const float y = 1 - (2 * float(i) + 1) / float(count), r = std::sqrt(1 - y * y), phi = 2.399963f * float(i);
        Ray ray;
        ray.origin = origin;
        ray.direction = {r * std::cos(phi), y, r * std::sin(phi)};
        rays.push_back(ray);
    }
    return rays;
}

struct Seen {
    std::vector<Hit> hits;
    std::vector<Surface> surfaces;
};

Seen look(const Tracer& tracer, const std::vector<Ray>& rays) {
    Seen seen{std::vector<Hit>(rays.size()), std::vector<Surface>(rays.size())};
    tracer.closestHits(rays, seen.hits).value();
    tracer.surfaces(rays, seen.hits, seen.surfaces).value();
    return seen;
}

class BuiltinTest : public ::testing::TestWithParam<std::string> {
protected:
    Scene make() const { return makeBuiltinScene(GetParam()).value(); }
    bool facesInwards() const { return GetParam() == "furnace" || GetParam() == "sphere"; }
};

TEST_P(BuiltinTest, IsValidAndComplete) {
    const Scene scene = make();
    const Result<void> valid = validate(scene);
    ASSERT_TRUE(valid) << valid.error().message;
    const ScenePose pose = poseAt(scene);
    EXPECT_EQ(scene.name, GetParam());
    EXPECT_GT(triangleCount(scene, pose), 0u);
    ASSERT_FALSE(pose.cameras.empty());
    std::set<std::string> names;
    for (const PlacedCamera& camera : pose.cameras) names.insert(camera.name);
    EXPECT_EQ(names.size(), pose.cameras.size()) << "camera names must differ";
    EXPECT_EQ(names.count(""), 0u);
    const bool emits = std::any_of(scene.materials.begin(), scene.materials.end(),
                                   [](const Material& m) { return m.emission != glm::vec3(0); });
    EXPECT_TRUE(emits || !pose.lights.empty() || !scene.sky.black());
}

TEST_P(BuiltinTest, ReflectsAtMost85Percent) {
    const Scene scene = make();
    for (const Material& m : scene.materials) {
        if (m.baseColorTexture.image >= 0) continue;
        EXPECT_LE(std::max({m.baseColor.x, m.baseColor.y, m.baseColor.z}), 0.85f) << m.name;
    }
    // 0.85 linear is 237 of 255 in sRGB.
    for (const Material& m : scene.materials) {
        if (m.baseColorTexture.image < 0) continue;
        const TextureImage& image = scene.images[std::size_t(m.baseColorTexture.image)];
        EXPECT_LE(image.width, 512);
        EXPECT_LE(image.height, 512);
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
            ASSERT_LE(std::max({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]}), 237) << m.name;
        }
    }
}

TEST_P(BuiltinTest, IsMadeOfClosedSolids) {
    const Scene scene = make();
    for (const Mesh& mesh : scene.meshes) {
        const test::WeldedMesh welded = test::weld(scene, mesh);
        if (welded.indices.empty()) continue;
        EXPECT_EQ(test::openEdges(welded), 0u) << mesh.name;
        const double volume = test::signedVolume(welded);
        EXPECT_GT(facesInwards() ? -volume : volume, 0) << mesh.name;
    }
}

TEST_P(BuiltinTest, UsesEveryMeshAndHasNoMirroredNodes) {
    const Scene scene = make();
    const ScenePose pose = poseAt(scene);
    std::set<int> used;
    for (const Instance& instance : pose.instances) {
        used.insert(instance.mesh);
        EXPECT_GT(glm::determinant(glm::mat3(instance.toWorld)), 0.0f);
    }
    EXPECT_EQ(used.size(), scene.meshes.size());
}

TEST_P(BuiltinTest, CamerasStandInTheOpenAndSeeFronts) {
    const auto built = build(GetParam());
    for (const PlacedCamera& camera : built->pose.cameras) {
        const Seen seen = look(*built->tracer, raysAround(camera.position, 400));
        std::size_t backs = 0, near = 0, hits = 0;
        for (std::size_t i = 0; i < seen.hits.size(); ++i) {
            if (!seen.hits[i].valid()) continue;
            ++hits;
            backs += seen.surfaces[i].backface;
            near += seen.hits[i].distance < 0.1f;
        }
        EXPECT_GT(hits, 0u) << camera.name;
        // Rays along an edge shared by two solids may slip between them.
        EXPECT_LE(backs, 1u) << camera.name;
        EXPECT_EQ(near, 0u) << camera.name;
    }
}

TEST_P(BuiltinTest, IsTheSameEveryTime) {
    const Scene a = make(), b = make();
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t m = 0; m < a.meshes.size(); ++m) {
        ASSERT_EQ(a.meshes[m].primitives.size(), b.meshes[m].primitives.size());
        for (std::size_t p = 0; p < a.meshes[m].primitives.size(); ++p) {
            EXPECT_EQ(a.meshes[m].primitives[p].positions, b.meshes[m].primitives[p].positions);
        }
    }
    for (std::size_t i = 0; i < a.images.size(); ++i) EXPECT_EQ(a.images[i].rgba, b.images[i].rgba);
}

std::vector<std::string> names() {
    std::vector<std::string> out;
    for (const BuiltinScene& scene : builtinScenes()) out.emplace_back(scene.name);
    return out;
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinTest, ::testing::ValuesIn(names()), [](const auto& test) {
    std::string name = test.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(Builtin, AnUnknownNameListsTheKnownOnes) {
    const auto result = makeBuiltinScene("sponza");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
    EXPECT_THAT(result.error().message, HasSubstr("'sponza'"));
    for (const BuiltinScene& scene : builtinScenes()) {
        EXPECT_THAT(result.error().message, HasSubstr(std::string(scene.name)));
        EXPECT_FALSE(scene.description.empty());
    }
}

TEST(Builtin, ParametersOutOfRangeAreRefused) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const auto refused = [](std::string_view scene, const char* parameter, float BuiltinParams::*field, float value) {
        BuiltinParams params;
        params.*field = value;
        const auto result = makeBuiltinScene(scene, params);
        ASSERT_FALSE(result) << scene << " " << parameter << " " << value;
        EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
        EXPECT_THAT(result.error().message, HasSubstr(parameter));
    };
    for (const char* scene : {"two-rooms", "dark-room"}) {
        for (const float v : {0.01f, 0.31f, kNan}) refused(scene, "wallThickness", &BuiltinParams::wallThickness, v);
    }
    for (const char* scene : {"furnace", "sphere"}) {
        for (const float v : {-0.1f, 1.0f, kNan}) refused(scene, "albedo", &BuiltinParams::albedo, v);
    }
    for (const float v : {0.0f, -1.0f, kNan, std::numeric_limits<float>::infinity()}) {
        refused("furnace", "emission", &BuiltinParams::emission, v);
        refused("sphere", "power", &BuiltinParams::power, v);
        refused("sphere", "radius", &BuiltinParams::radius, v);
    }
    BuiltinParams unused;
    unused.power = -1;
    EXPECT_TRUE(makeBuiltinScene("cornell", unused));
}

TEST(Builtin, TheAtriumIsLarge) {
    const Scene scene = makeBuiltinScene("atrium").value();
    EXPECT_GE(triangleCount(scene, poseAt(scene)), 100'000u);
}

TEST(Builtin, TheTerrainIsAMillionTrianglesWithoutSeams) {
    const auto built = build("terrain", {});
    EXPECT_GE(triangleCount(built->scene, built->pose), 1'000'000u);
    // Straight down everywhere, on the tiles' seams too: always ground, a stone or a hut, from its front.
    std::vector<Ray> rays;
    for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 60; ++j)
            rays.push_back({.origin = {-126.0f + 4.2f * float(i), 60,
                                       j % 2 ? -64.0f + 32.0f * float(j % 5) : 2.1f * float(j - 30)},
                            .direction = {0, -1, 0}});
    const Seen seen = look(*built->tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(seen.hits[i].valid()) << i;
        EXPECT_FALSE(seen.surfaces[i].back) << i;
        EXPECT_GT(seen.surfaces[i].position.y, 0.0f) << i;
    }
}

TEST(Builtin, TheSphereHasTheAreaAndTheLightItClaims) {
    BuiltinParams params;
    params.radius = 2.5f;
    params.power = 40;
    const Scene scene = makeBuiltinScene("sphere", params).value();
    const ScenePose pose = poseAt(scene);
    const test::WeldedMesh mesh = test::weld(scene, scene.meshes[0]);
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_NEAR(area / (4 * glm::pi<double>() * 2.5 * 2.5), 1, 1e-5);
    ASSERT_EQ(pose.lights.size(), 1u);
    EXPECT_NEAR(4 * glm::pi<float>() * pose.lights[0].intensity.x, 40, 1e-3f);
    EXPECT_EQ(pose.lights[0].position, glm::vec3(0));
}

TEST(Builtin, TheFurnaceTakesItsParameters) {
    BuiltinParams params;
    params.albedo = 0.9f;
    params.emission = 123;
    const auto built = [&] { return makeBuiltinScene("furnace", params).value(); }();
    ASSERT_EQ(built.materials.size(), 1u);
    EXPECT_EQ(glm::vec3(built.materials[0].baseColor), glm::vec3(0.9f));
    EXPECT_EQ(built.materials[0].emission, glm::vec3(123));
}

class DarkRoomTest : public ::testing::TestWithParam<float> {};

TEST_P(DarkRoomTest, NoRayLeavesTheSealedRoom) {
    BuiltinParams params;
    params.wallThickness = GetParam();
    const auto built = build("dark-room", params);
    const float inner = 0.5f * GetParam();
    for (const glm::vec3 offset :
         {glm::vec3(4.9f, 2.7f, 2.4f), glm::vec3(2.5f, 2.2f, 0), glm::vec3(0.1f, 0.05f, -2.45f)}) {
        const std::vector<Ray> rays = raysAround(glm::vec3(inner, 0, 0) + offset, 3000);
        const Seen seen = look(*built->tracer, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_TRUE(seen.hits[i].valid());
            EXPECT_FALSE(seen.surfaces[i].backface);
            const glm::vec3 p = seen.surfaces[i].position;
            EXPECT_GE(p.x, inner - 1e-3f);
            EXPECT_LE(p.x, inner + 5.001f);
            EXPECT_GE(p.y, -1e-3f);
            EXPECT_LE(p.y, 2.801f);
            EXPECT_LE(std::abs(p.z), 2.501f);
        }
    }
}

TEST_P(DarkRoomTest, InsideTheWallsOnlyBacksAreSeen) {
    BuiltinParams params;
    params.wallThickness = GetParam();
    const auto built = build("dark-room", params);
    for (const glm::vec3 inWall : {glm::vec3(0, 1.4f, 0.3f), glm::vec3(2.1f, 2.8f + 0.5f * GetParam(), 0.4f)}) {
        const Seen seen = look(*built->tracer, raysAround(inWall, 1000));
        for (std::size_t i = 0; i < seen.hits.size(); ++i) {
            ASSERT_TRUE(seen.hits[i].valid());
            EXPECT_TRUE(seen.surfaces[i].backface);
        }
    }
}

TEST_P(DarkRoomTest, TheOtherRoomSeesTheSky) {
    BuiltinParams params;
    params.wallThickness = GetParam();
    const auto built = build("dark-room", params);
    const Seen seen = look(*built->tracer, raysAround({-2.5f, 1.5f, 1.5f}, 1000));
    const auto missed = std::count_if(seen.hits.begin(), seen.hits.end(), [](const Hit& h) { return !h.valid(); });
    EXPECT_GT(missed, 50);
}

INSTANTIATE_TEST_SUITE_P(Walls, DarkRoomTest, ::testing::Values(0.02f, 0.1f, 0.3f));

TEST(Builtin, TwoRoomsAreJoinedByTheirDoorway) {
    const auto built = build("two-rooms");
    Ray ray;
    ray.origin = {-2.0f, 1.2f, 0.4f};
    ray.direction = {1, 0, 0};
    std::vector<Ray> rays{ray};
    const Seen seen = look(*built->tracer, rays);
    ASSERT_TRUE(seen.hits[0].valid());
    EXPECT_GT(seen.surfaces[0].position.x, 4.9f);
}

}  // namespace
}  // namespace probegi
