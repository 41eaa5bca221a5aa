#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/squares.h"
#include "cli/tool.h"
#include "probegi/builtin_scenes.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

TEST(Inspect, ScenesListsAllOfThem) {
    const ToolRun run = runTool({"scenes"});
    EXPECT_EQ(run.exitCode, 0);
    for (const BuiltinScene& scene : builtinScenes()) {
        EXPECT_THAT(run.out, HasSubstr(std::string(scene.name)));
        EXPECT_THAT(run.out, HasSubstr(std::string(scene.description)));
    }
}

TEST(Inspect, InfoOfEveryBuiltinScene) {
    for (const BuiltinScene& scene : builtinScenes()) {
        const std::string name = "builtin:" + std::string(scene.name);
        const auto info = nlohmann::json::parse(runTool({"info", name, "--json"}).out);
        EXPECT_GT(info["triangles"], 0) << name;
        EXPECT_TRUE(info["lit"]) << name;
        EXPECT_GT(info["grid"]["probes"], 0) << name;
        EXPECT_TRUE(info["warnings"].empty()) << name;
    }
}

/// A room of 8 x 3 x 4 m, of six squares that face inward, turned by 30 degrees about the vertical.
std::string turnedRoom() {
    const double h = 0.70710678;
    return sceneOfSquares(
               {{{"rotation", {0, 0.25881905, 0, 0.96592583}}, {"children", {1, 2, 3, 4, 5, 6}}},
                {{"mesh", 0}, {"scale", {8, 1, 4}}},
                {{"mesh", 0}, {"scale", {8, 1, 4}}, {"rotation", {1, 0, 0, 0}}, {"translation", {0, 3, 4}}},
                {{"mesh", 0}, {"scale", {3, 1, 4}}, {"rotation", {0, 0, -h, h}}, {"translation", {0, 3, 0}}},
                {{"mesh", 0}, {"scale", {3, 1, 4}}, {"rotation", {0, 0, h, h}}, {"translation", {8, 0, 0}}},
                {{"mesh", 0}, {"scale", {8, 1, 3}}, {"rotation", {h, 0, 0, h}}, {"translation", {0, 3, 0}}},
                {{"mesh", 0}, {"scale", {8, 1, 3}}, {"rotation", {-h, 0, 0, h}}, {"translation", {0, 0, 4}}}})
        .dump();
}

TEST(Inspect, AGridTurnsWithItsRoom) {
    const TemporaryFolder folder;
    const std::string scene = folder.file("room.gltf"), stats = folder.file("stats.json");
    std::ofstream(scene) << turnedRoom();
    const auto info = nlohmann::json::parse(runTool({"info", scene, "--json"}).out);
    EXPECT_NEAR(info["grid"]["turnedDegrees"].get<double>(), 30, 0.1);
    EXPECT_THAT(runTool({"info", scene}).out, HasSubstr("turned by 30.0 degrees"));
    const auto picture = [&](const char* turn) {
        const ToolRun run = runTool({"render",      scene,
                                     "-o",          folder.file("a.exr"),
                                     "--size",      "16x9",
                                     "--aov",       "irradiance",
                                     "--point",     "3,1.5,0,5,5,5",
                                     "--look-from", "2,1.5,0.5",
                                     "--look-at",   "5,1,-1",
                                     "--rays",      "16",
                                     "--frames",    "1",
                                     "--turn-grid", turn,
                                     "--stats",     stats});
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return readText(folder.file("a.exr"));
    };
    const std::string turned = picture("on");
    EXPECT_EQ(nlohmann::json::parse(readText(stats))["probes"], info["grid"]["probes"]);
    EXPECT_NE(picture("off"), turned) << "other probes";
    expectRefused({"render", scene, "-o", folder.file("b.png"), "--turn-grid", "perhaps"}, "--turn-grid", 2);
}

TEST(Inspect, InfoAsText) {
    const ToolRun text = runTool({"info", "builtin:sphere"});
    EXPECT_EQ(text.exitCode, 0);
    for (const char* word : {"triangles", "materials", "bounds", "lights", "point", "cameras", "inside", "probe grid"})
        EXPECT_THAT(text.out, HasSubstr(word));
}

TEST(Inspect, CompareMeasuresAndDraws) {
    const TemporaryFolder folder;
    const std::string a = folder.file("a.exr"), b = folder.file("b.exr"), map = folder.file("map.png");
    ASSERT_TRUE(writeImage(a, HdrImage(32, 18, glm::vec3(0.5f))));
    ASSERT_TRUE(writeImage(b, HdrImage(32, 18, glm::vec3(0.25f))));
    const auto measure = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "compare");
        arguments.push_back("--json");
        const ToolRun run = runTool(arguments);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    const auto same = measure({a, a});
    EXPECT_EQ(same.size(), 5u);
    for (const char* key : {"rmse", "relmse", "scaledRelmse", "flip"}) EXPECT_EQ(same[key], 0) << key;
    EXPECT_EQ(same["ratio"]["mean"], 1);
    const auto different = measure({a, b, "--heatmap", map});
    for (const char* key : {"rmse", "relmse", "scaledRelmse", "flip"}) EXPECT_GT(different[key], 0) << key;
    for (const char* key : {"mean", "p5", "median", "p95"})
        EXPECT_NEAR(double(different["ratio"][key]), 2, 1e-3) << key;
    EXPECT_EQ(different["ratio"]["blocks"], 40);
    EXPECT_TRUE(readImage(map));
    EXPECT_LT(measure({a, b, "--exposure", "0.01"})["rmse"], different["rmse"]);
    EXPECT_THAT(runTool({"compare", a, b}).out, HasSubstr("flip"));
    EXPECT_THAT(runTool({"compare", a, b}).out, HasSubstr("in 40 blocks 2.000, 2.000, 2.000"));
}

TEST(Inspect, CompareRefusesDifferentSizes) {
    const TemporaryFolder folder;
    const std::string a = folder.file("a.exr"), b = folder.file("b.exr");
    ASSERT_TRUE(writeImage(a, HdrImage(32, 18)));
    ASSERT_TRUE(writeImage(b, HdrImage(18, 32)));
    const ToolRun run = runTool({"compare", a, b, "--heatmap", folder.file("map.png")});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("32x18"));
    EXPECT_EQ(folder.entries(), 2u);
}

}  // namespace
}  // namespace probegi::test
