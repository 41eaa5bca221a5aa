#include "probegi/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "reference/irradiance_estimate.h"
#include "reference/path_batch.h"
#include "support/analytic_tracer.h"
#include "support/reference_world.h"

namespace probegi {
namespace {

using namespace test;

constexpr float kPi = 3.14159265f;

/// A room with a lamp in its ceiling, a point light, a window to the sky, and a glossy block.
Scene busyRoom() {
    Scene scene;
    const int white = addMaterial(scene, {0.7f, 0.6f, 0.5f});
    const int lamp = addMaterial(scene, glm::vec3(0.2f), {6, 5, 4});
    const int metal = addMaterial(scene, {0.9f, 0.8f, 0.6f});
    scene.materials[std::size_t(metal)].metallic = 1.0f;
    scene.materials[std::size_t(metal)].roughness = 0.4f;
    addQuad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, white);
    addQuad(scene, {-2, 3, -2}, {4, 0, 0}, {0, 0, 4}, white);
    addQuad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, white);
    addQuad(scene, {-2, 0, -2}, {0, 3, 0}, {0, 0, 4}, white);
    addQuad(scene, {-0.5f, 2.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp);
    addQuad(scene, {0.5f, 0.6f, -1}, {0, 0, 1}, {1, 0, 0}, metal);
    scene.sky.radiance = {0.3f, 0.5f, 0.9f};
    Light light;
    light.intensity = glm::vec3(3.0f);
    scene.lights.push_back(light);
    Node node;
    node.translation = {1.2f, 2.2f, 0.8f};
    node.light = 0;
    scene.addNode(node);
    return scene;
}

ReferenceDesc smallPicture(int samples, std::uint64_t seed = 1) {
    ReferenceDesc desc;
    desc.picture = {.camera = lookAt({1.5f, 1.5f, 4}, {0, 1.2f, 0}), .width = 16, .height = 12, .diffuseOnly = false};
    desc.samplesPerPixel = samples;
    desc.seed = seed;
    return desc;
}

double meanLevel(const HdrImage& image) {
    double sum = 0;
    for (const glm::vec3& p : image.pixels) sum += double(p.x + p.y + p.z);
    return sum / double(3 * image.pixels.size());
}

/// Standard error of meanLevel, from those of the pixels.
double meanLevelError(const HdrImage& error) {
    double square = 0;
    for (const glm::vec3& p : error.pixels) square += std::pow(double(p.x + p.y + p.z) / 3, 2);
    return std::sqrt(square) / double(error.pixels.size());
}

TEST(Reference, sameBitsForOneAndTwoThreads) {
    const ReferenceWorld one(busyRoom(), 1), two(busyRoom(), 2);
    const auto a = one.pathTracer().render(smallPicture(40)), b = two.pathTracer().render(smallPicture(40));
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->picture.color.pixels, b->picture.color.pixels);
    EXPECT_EQ(a->picture.irradiance.pixels, b->picture.irradiance.pixels);
    EXPECT_EQ(a->standardError.pixels, b->standardError.pixels);

    const std::vector<FieldQuery> points = {{{0, 1, 0}, {0, 1, 0}, {}}, {{1, 1, 1}, {0, 0, -1}, {}}};
    const auto ea = one.pathTracer().irradiance(points, 3000), eb = two.pathTracer().irradiance(points, 3000);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ((*ea)[i].mean, (*eb)[i].mean);
        EXPECT_EQ((*ea)[i].standardError, (*eb)[i].standardError);
    }
}

TEST(Reference, twoSeedsDifferButAgreeWithinTheirErrors) {
    const ReferenceWorld world(busyRoom());
    const auto a = world.pathTracer().render(smallPicture(48, 1)), b = world.pathTracer().render(smallPicture(48, 2));
    EXPECT_NE(a->picture.color.pixels, b->picture.color.pixels);
    const double error = std::hypot(meanLevelError(a->standardError), meanLevelError(b->standardError));
    EXPECT_NEAR(meanLevel(a->picture.color), meanLevel(b->picture.color), 3 * error);
    EXPECT_LT(error, 0.03 * meanLevel(a->picture.color));
}

TEST(Reference, layersAddUpAndNothingIsNegative) {
    const ReferenceWorld world(busyRoom());
    const auto result = world.pathTracer().render(smallPicture(16));
    const Picture& p = result->picture;
    EXPECT_EQ(result->samplesPerPixel, 16);
    for (std::size_t i = 0; i < p.color.pixels.size(); ++i) {
        // The rest is sky: the share of the pixel that shows it, in the sky's colour.
        const glm::vec3 rest = p.color.pixels[i] - p.direct.pixels[i] - p.indirect.pixels[i];
        const float share = rest.x / world.scene.sky.radiance.x;
        EXPECT_NEAR(share * 16, std::round(share * 16), 1e-2f);
        EXPECT_LE(share, 1.001f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(std::isfinite(p.color.pixels[i][c]));
            EXPECT_GE(p.indirect.pixels[i][c], 0.0f);
            EXPECT_GE(p.irradiance.pixels[i][c], 0.0f);
            EXPECT_NEAR(rest[c], share * world.scene.sky.radiance[c], 1e-3f);
        }
    }
}

/// With Lambert surfaces only, indirect light is albedo / pi times the irradiance layer, path by path.
TEST(Reference, irradianceIsWhatLiesBehindIndirect) {
    const ReferenceWorld world(busyRoom());
    ReferenceDesc desc = smallPicture(8);
    desc.picture.diffuseOnly = true;
    desc.picture.camera = lookAt({0, 1.5f, 0}, {-0.5f, 0, 0.5f}, 0.2f);  // the floor only
    const auto result = world.pathTracer().render(desc);
    for (std::size_t i = 0; i < result->picture.color.pixels.size(); ++i) {
        const glm::vec3 albedo = result->picture.albedo.pixels[i];
        EXPECT_NEAR(glm::length(albedo - glm::vec3(0.7f, 0.6f, 0.5f)), 0, 1e-5f);
        const glm::vec3 behind = result->picture.irradiance.pixels[i] * albedo / kPi;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(behind[c], result->picture.indirect.pixels[i][c], 1e-4f * (1 + behind[c]));
    }
}

/// A picture's irradiance at a point equals that of irradiance().
TEST(Reference, pictureAndPointQueriesAgree) {
    const ReferenceWorld world(busyRoom());
    ReferenceDesc desc = smallPicture(4000);
    desc.picture = {.camera = lookAt({0, 1e-2f, 0}, {0, 0, 0}, 0.01f), .width = 1, .height = 1, .diffuseOnly = true};
    const glm::vec3 inPicture = world.pathTracer().render(desc)->picture.irradiance.at(0, 0);
    const auto atPoint = world.pathTracer().irradiance(std::vector<FieldQuery>(1), 8000);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(inPicture[c], atPoint->front().mean[c], 5 * atPoint->front().standardError[c]);
}

/// Lamp, sky and glossy metal: all ways of sampling find the same light.
TEST(Reference, everyStrategyHasTheSameMean) {
    const ReferenceWorld world(busyRoom());
    const Transport transport = world.transport();
    const std::vector<FieldQuery> points = {{{0.5f, 0, 0}, {0, 1, 0}, {}}, {{-1.9f, 1, 0.5f}, {1, 0, 0}, {}}};
    const auto estimate = [&](Strategy strategy, bool diffuseOnly) {
        return *estimateIrradiance(world.context, transport, {diffuseOnly, 0, strategy}, points, 12000, 11);
    };
    for (const bool diffuseOnly : {true, false}) {
        const auto both = estimate(Strategy::both, diffuseOnly);
        for (const Strategy strategy : {Strategy::bsdfOnly, Strategy::lightsOnly}) {
            const auto other = estimate(strategy, diffuseOnly);
            for (std::size_t i = 0; i < points.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(both[i].mean[c], other[i].mean[c],
                                3 * std::hypot(both[i].standardError[c], other[i].standardError[c]));
        }
    }
}

/// The same room as triangles in Embree and as equations in the analytic tracer.
TEST(Reference, doesNotDependOnTheTracer) {
    Scene scene;
    const int white = addMaterial(scene, glm::vec3(0.6f)), lamp = addMaterial(scene, glm::vec3(0.1f), glm::vec3(5.0f));
    addQuad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, white);
    addQuad(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, lamp);
    auto analytic = std::make_unique<AnalyticTracer>();
    analytic->materials = scene.materials;
    analytic->addQuad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, white);
    analytic->addQuad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, lamp);
    const ReferenceWorld triangles(scene), equations(scene, 1, std::move(analytic));
    const FieldQuery up{{0.5f, 0, 0.2f}, {0, 1, 0}, {}}, down{{0, 1, 0}, {0, -1, 0}, {}};
    for (const FieldQuery& q : {up, down}) {
        const auto a = triangles.pathTracer().irradiance({&q, 1}, 6000, 1)->front();
        const auto b = equations.pathTracer().irradiance({&q, 1}, 6000, 2)->front();
        EXPECT_NEAR(a.mean.x, b.mean.x, 3 * std::hypot(a.standardError.x, b.standardError.x));
    }
}

/// (mean - truth) / standardError over many seeds has variance 1, so the reported error is right.
TEST(Reference, standardErrorIsHonest) {
    Scene scene;
    addRoom(scene, {-1, -1, -1}, {1, 1, 1}, addMaterial(scene, glm::vec3(0.5f), glm::vec3(1.0f)));
    const ReferenceWorld world(scene);
    const PathTracer tracer = world.pathTracer();
    double sum = 0, squares = 0;
    constexpr int kSeeds = 200;
    for (int seed = 0; seed < kSeeds; ++seed) {
        const auto e = tracer.irradiance(std::vector<FieldQuery>(1), 1600, std::uint64_t(seed))->front();
        const double z = double(e.mean.x - 2 * kPi) / double(e.standardError.x);
        sum += z;
        squares += z * z;
    }
    // The mean is slightly negative: if the mean of skewed samples is low, so is its error.
    EXPECT_NEAR(sum / kSeeds, 0, 4 / std::sqrt(double(kSeeds)));
    EXPECT_NEAR(squares / kSeeds, 1, 4 * std::sqrt(2.0 / kSeeds));
}

/// One reflection is direct light only, and more bounces only add to it.
TEST(Reference, maxBouncesCountsReflections) {
    const ReferenceWorld world(busyRoom());
    ReferenceDesc desc = smallPicture(32);
    double before = 0;
    for (const int bounces : {1, 2, 4, 0}) {
        desc.maxBounces = bounces;
        const double level = meanLevel(world.pathTracer().render(desc)->picture.color);
        EXPECT_GT(level, before);
        before = level;
    }
}

TEST(Reference, stopsByErrorAndByTime) {
    const ReferenceWorld world(busyRoom());
    ReferenceDesc desc = smallPicture(0);
    desc.relativeError = 0.2;
    const auto byError = world.pathTracer().render(desc);
    ASSERT_TRUE(byError);
    EXPECT_GE(byError->samplesPerPixel, 16);
    EXPECT_LE(meanLevel(byError->standardError), 0.25 * meanLevel(byError->picture.color));

    desc.relativeError = 0;
    desc.seconds = 0.02;
    EXPECT_GE(world.pathTracer().render(desc)->samplesPerPixel, 1);
}

TEST(Reference, badArgumentsAreSentences) {
    const ReferenceWorld world(busyRoom());
    const PathTracer tracer = world.pathTracer();
    const auto messageOf = [&](auto change) {
        ReferenceDesc desc = smallPicture(4);
        change(desc);
        const auto result = tracer.render(desc);
        EXPECT_FALSE(result);
        if (result) return std::string();
        EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
        return result.error().message;
    };
    EXPECT_THAT(messageOf([](ReferenceDesc& d) { d.samplesPerPixel = 0; }), testing::HasSubstr("stopping rule"));
    EXPECT_THAT(messageOf([](ReferenceDesc& d) { d.picture.width = 0; }), testing::HasSubstr("size"));
    EXPECT_THAT(messageOf([](ReferenceDesc& d) { d.picture.camera.yfov = 4; }), testing::HasSubstr("yfov"));
    EXPECT_THAT(messageOf([](ReferenceDesc& d) { d.maxBounces = -1; }), testing::HasSubstr("maxBounces"));
    EXPECT_EQ(tracer.irradiance(std::vector<FieldQuery>(1), 0).error().code, ErrorCode::invalidArgument);
    EXPECT_TRUE(tracer.irradiance({}, 10)->empty());
}

TEST(Reference, canBeCancelled) {
    const ReferenceWorld world(busyRoom());
    const Context context = *Context::create(
        {.threads = 2, .log = {}, .progress = [](const ProgressReport& report) { return report.fraction >= 1; }});
    const PathTracer tracer = *PathTracer::create(context, world.scene, world.pose, *world.tracer, world.lighting);
    ReferenceDesc desc = smallPicture(1'000'000);
    EXPECT_EQ(tracer.render(desc).error().code, ErrorCode::cancelled);
    EXPECT_EQ(tracer.irradiance(std::vector<FieldQuery>(1), 100'000'000).error().code, ErrorCode::cancelled);
}

TEST(Reference, emptySceneShowsTheSky) {
    Scene scene;
    scene.sky.radiance = {1, 2, 3};
    const ReferenceWorld world(scene);
    const auto result = world.pathTracer().render(smallPicture(2));
    ASSERT_TRUE(result) << result.error().message;
    for (const glm::vec3& pixel : result->picture.color.pixels) EXPECT_EQ(pixel, glm::vec3(1, 2, 3));
    EXPECT_EQ(result->picture.depth.at(3, 3), glm::vec3(0.0f));
}

/// 2 cm walls far from the origin, sunlight outside, many corners: no light may come through.
TEST(Reference, thinWallsDoNotLeak) {
    for (const float far : {0.0f, 40.0f}) {
        Scene scene;
        const int wall = addMaterial(scene, glm::vec3(0.8f));
        const glm::vec3 at(far, 0, -far), inner(1, 1, 1), outer(1.02f);
        addRoom(scene, at - inner, at + inner, wall);
        const std::size_t first = scene.meshes.size();
        addRoom(scene, at - outer, at + outer, wall);
        for (std::size_t m = first; m < scene.meshes.size(); ++m) {
            auto& indices = scene.meshes[m].primitives[0].indices;
            for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
        }
        Light sun;
        sun.type = LightType::directional;
        sun.intensity = glm::vec3(1e4f);
        scene.lights.push_back(sun);
        Node node;
        node.rotation = glm::quat(0.8f, -0.5f, 0.3f, 0.1f);
        node.light = 0;
        scene.addNode(node);
        scene.sky.radiance = glm::vec3(1e3f);
        const ReferenceWorld world(scene);
        std::vector<FieldQuery> points;
        for (const float x : {-1.0f, -0.999f, 0.0f, 0.999f})
            points.push_back({at + glm::vec3(x, -1, 0.5f * x), {0, 1, 0}, {}});
        const auto result = world.pathTracer().irradiance(points, 2000);
        for (const ReferenceIrradiance& e : *result) EXPECT_EQ(e.mean, glm::vec3(0.0f));
    }
}

}  // namespace
}  // namespace probegi
