#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "probegi/builtin_scenes.h"
#include "probegi/measure.h"

namespace probegi {
namespace {

TEST(SurfaceError, byHand) {
    // The mean truth is 2; the last point is below a hundredth of it and is ignored, however wrong.
    SurfaceTruth truth{{}, {1, 3, 3.99, 0.01}, {0, 0, 0, 0}};
    const auto error = compareAtSurfaces(std::vector<double>{1.5, 3, 3.99, 7}, truth);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->points, 3u);
    EXPECT_NEAR(error->mean, 8.49 / 7.99, 1e-12);
    EXPECT_NEAR(error->rms, std::sqrt(0.25 / 3) / (7.99 / 3), 1e-12);
    EXPECT_NEAR(error->median, 1, 1e-12);
    EXPECT_NEAR(error->high, 1.45, 1e-12) << "nine tenths of the way from 1 to 1.5";
}

TEST(SurfaceError, theTruthsNoiseIsTakenOut) {
    const SurfaceTruth truth{{}, {1, 1}, {0.3, 0.3}};
    EXPECT_NEAR(compareAtSurfaces(std::vector<double>{1.3, 0.7}, truth)->rms, 0, 1e-6);
    EXPECT_NEAR(compareAtSurfaces(std::vector<double>{1.5, 0.5}, truth)->rms, 0.4, 1e-12);
}

TEST(SurfaceError, ofBlackAndOfUnequalLengths) {
    EXPECT_EQ(compareAtSurfaces(std::vector<double>{1}, {{}, {0}, {0}})->points, 0u);
    EXPECT_EQ(compareAtSurfaces(std::vector<double>{1}, {{}, {0}, {0}})->rms, 0);
    EXPECT_FALSE(compareAtSurfaces(std::vector<double>{1, 2}, SurfaceTruth{{}, {1}, {0}}));
}

/// A closed box of albedo 1/2 and emission 2: E = pi Le / (1 - a) everywhere inside.
struct Furnace {
    Context context = *Context::create({.threads = 2});
    Scene scene = *makeBuiltinScene("furnace", {.albedo = 0.5f, .emission = 2.0f});
    ScenePose pose = poseAt(scene);
    std::unique_ptr<Tracer> tracer = std::move(*makeEmbreeTracer(context, scene, pose));

    /// Expects a point on one of the six faces with its normal towards the middle.
    void expectInside(const FieldQuery& q) const {
        const glm::vec3 size = pose.bounds.size();
        EXPECT_NEAR(glm::length(q.normal), 1, 1e-4f);
        EXPECT_NEAR(glm::dot(q.position - pose.bounds.centre(), q.normal), -0.5f * std::abs(glm::dot(size, q.normal)),
                    1e-3f);
        EXPECT_GE(glm::dot(q.toViewer, q.normal), 0);
        EXPECT_NEAR(glm::length(q.toViewer), 1, 1e-4f);
    }
};

TEST(SurfacePoints, lieOnWallsByTheirArea) {
    const Furnace furnace;
    const auto points = surfacePoints(furnace.scene, furnace.pose, *furnace.tracer, 3000);
    ASSERT_TRUE(points);
    ASSERT_EQ(points->size(), 3000u);
    const glm::vec3 size = furnace.pose.bounds.size();
    const glm::vec3 area(size.y * size.z, size.z * size.x, size.x * size.y);
    glm::vec3 counts(0), views(0);
    for (const FieldQuery& q : *points) {
        furnace.expectInside(q);
        counts += glm::abs(q.normal);
        views += glm::dot(q.toViewer, q.normal) / 3000.0f;
    }
    const float all = area.x + area.y + area.z;
    for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(counts[a] / 3000, area[a] / all, 4 * 0.0091f) << "four standard errors of a share";
    EXPECT_NEAR(views.x, 2.0 / 3, 0.02) << "the mean cosine of a direction by its cosine";
}

TEST(SurfacePoints, aSceneWithoutTrianglesHasNone) {
    const Context context = *Context::create({.threads = 1});
    const Scene empty;
    const auto tracer = makeEmbreeTracer(context, empty, poseAt(empty));
    ASSERT_TRUE(tracer);
    EXPECT_TRUE(surfacePoints(empty, poseAt(empty), **tracer, 10)->empty());
}

TEST(VisiblePoints, lieWhereRaysEnd) {
    const Furnace furnace;
    const auto points = visiblePoints(*furnace.tracer, furnace.pose.bounds, 500);
    ASSERT_TRUE(points);
    ASSERT_EQ(points->size(), 500u);
    for (const FieldQuery& q : *points) furnace.expectInside(q);
}

TEST(SurfaceTruth, aClosedFurnaceIsKnown) {
    const Furnace furnace;
    const auto pathTracer = PathTracer::create(furnace.context, furnace.scene, furnace.pose, *furnace.tracer, {});
    ASSERT_TRUE(pathTracer);
    const auto points = surfacePoints(furnace.scene, furnace.pose, *furnace.tracer, 20);
    const auto truth = traceSurfaceTruth(*pathTracer, *points, 256);
    ASSERT_TRUE(truth) << truth.error().message;
    ASSERT_EQ(truth->truth.size(), 20u);
    const double e = 3.14159265 * 2 / 0.5;
    for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(truth->truth[i], e, 5 * truth->standardError[i] + 1e-3);
    EXPECT_NEAR(compareAtSurfaces(std::vector<double>(20, e), *truth)->mean, 1, 0.01);
}

TEST(SurfaceError, aFieldIsAskedAtThePoints) {
    FieldDesc desc;
    desc.raysPerProbe = 16;
    Field field = *Field::create(*Context::create({.threads = 1}), desc);
    ASSERT_TRUE(field.update(std::vector<RayDatum>(8 * 16, {glm::vec3(1, 2, 3), 100.0f})));
    const double e = 3.14159265 * (0.2126 + 2 * 0.7152 + 3 * 0.0722);
    const SurfaceTruth truth{{{glm::vec3(0.5f), {0, 1, 0}, {}}, {glm::vec3(0.4f), {1, 0, 0}, {}}}, {e, 2 * e}, {0, 0}};
    const auto error = compareAtSurfaces(field, truth);
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->mean, 2.0 / 3, 0.005);
    EXPECT_EQ(error->points, 2u);
}

}  // namespace
}  // namespace probegi
