#include "report/render.h"

#include <gtest/gtest.h>

namespace probegi::tool {
namespace {

// Two cameras, few probes, tiny pictures: every piece of work is announced, in the planned order.
TEST(ReportRender, PiecesAreThosePlannedAndEveryCameraIsDrawn) {
    SceneOptions options;
    options.scene = "builtin:two-rooms";
    options.probes = "4x4x4";
    options.exposure = "auto";
    auto setup = loadSetup(options);
    ASSERT_TRUE(setup) << setup.error().message;
    setup->pose.cameras.push_back(lookAt(setup->camera.position, setup->pose.bounds.centre() + glm::vec3(0, 0, 1)));
    setup->pose.cameras.back().name = "another";
    const Context context = Context::create({.threads = 2}).value();
    const auto backend = openBackend(context, BackendOptions{});
    ReportSettings settings;
    settings.width = 32;
    settings.height = 18;
    settings.raysPerProbe = 16;
    settings.run.frames = 2;
    settings.realtimeUpdates = 2;
    settings.seconds = 0;
    settings.samplesPerPixel = 2;
    settings.ratioProbes = 2;
    settings.ratioSamples = 4;
    settings.allCameras = true;
    std::vector<std::string> told, planned;
    settings.onPiece = [&](const std::string& piece) { told.push_back(piece); };
    for (const ReportPiece& piece : reportPieces(*setup, settings)) {
        planned.push_back(piece.name);
        EXPECT_GT(piece.seconds, 0) << piece.name;
    }
    const auto scene = renderForReport(context, **backend, *setup, settings);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(told, planned);
    const std::size_t cameras = reportCameras(*setup, settings).size();
    ASSERT_GE(cameras, 2u);
    ASSERT_EQ(scene->others.size(), cameras - 1);
    EXPECT_EQ(scene->others.back().camera.name, "another");
    EXPECT_EQ(scene->probes.size(), 64u);
    for (const RenderedView& view : scene->others) {
        EXPECT_EQ(view.reference.color.width, 16) << "half the size";
        EXPECT_EQ(view.ddgi.picture.color.width, 16);
        EXPECT_EQ(view.exposure, autoExposure(view.reference.color));
        EXPECT_GT(view.none.whole.difference.flip, 0);
    }
}

TEST(ReportRender, OneCameraWhereOneIsNamed) {
    SceneOptions options;
    options.scene = "builtin:two-rooms";
    const auto setup = loadSetup(options);
    ASSERT_TRUE(setup);
    EXPECT_EQ(reportCameras(*setup, {}).size(), 1u);
    EXPECT_EQ(setup->exposure, 1.5f) << "as the scene suggests, where nobody asked for more";
    EXPECT_FALSE(setup->automaticExposure);
}

}  // namespace
}  // namespace probegi::tool
