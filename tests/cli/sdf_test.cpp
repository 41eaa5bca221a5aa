// probegi render --sdf.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

// The Cornell box by hand.
constexpr const char* kCornell = R"({"sdf": 1, "primitives": [
 {"name": "floor", "shape": "box", "centre": [2.764, -0.1, -2.896], "halfSize": [2.964, 0.1, 2.896], "albedo": [0.725, 0.71, 0.68]},
 {"name": "ceiling", "shape": "box", "centre": [2.764, 5.588, -2.896], "halfSize": [2.964, 0.1, 2.896], "albedo": [0.725, 0.71, 0.68]},
 {"name": "back", "shape": "box", "centre": [2.764, 2.744, -5.692], "halfSize": [2.964, 2.744, 0.1], "albedo": [0.725, 0.71, 0.68]},
 {"name": "left", "shape": "box", "centre": [-0.1, 2.744, -2.796], "halfSize": [0.1, 2.744, 2.796], "albedo": [0.63, 0.065, 0.05]},
 {"name": "right", "shape": "box", "centre": [5.628, 2.744, -2.796], "halfSize": [0.1, 2.744, 2.796], "albedo": [0.14, 0.45, 0.091]},
 {"name": "lamp", "shape": "box", "centre": [2.748, 5.483, -2.795], "halfSize": [0.65, 0.005, 0.525], "emission": [17, 12, 4]},
 {"name": "short block", "shape": "box", "centre": [3.673, 0.825, -1.69], "rotation": [0, 0.5969305, 0, 0.8022929], "halfSize": [0.835225, 0.825, 0.824212], "albedo": [0.725, 0.71, 0.68]},
 {"name": "tall block", "shape": "box", "centre": [1.843, 1.65, -3.5125], "rotation": [0, 0.1497946, 0, 0.9887171], "halfSize": [0.827118, 1.65, 0.836675], "albedo": [0.725, 0.71, 0.68]}]})";

class Sdf : public testing::Test {
protected:
    Sdf() { writeText(file(), kCornell); }
    std::string file(const std::string& name = "cornell.sdf.json") const { return m_folder.file(name); }
    std::vector<std::string> arguments(const std::vector<std::string>& more) const {
        std::vector<std::string> all{"render", "builtin:cornell", "-o", file("a.exr"), "--size", "48x27"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    HdrImage render(const std::vector<std::string>& more) const {
        const ToolRun run = runTool(arguments(more));
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return readImage(file("a.exr")).value_or(HdrImage());
    }
    static std::vector<std::string> lit(std::vector<std::string> more) {
        more.insert(more.end(), {"--aov", "indirect", "--probes", "8x8x8", "--frames", "40", "--rays", "96"});
        return more;
    }

    TemporaryFolder m_folder;
};

glm::dvec3 mean(const HdrImage& image) {
    glm::dvec3 sum(0);
    for (const glm::vec3& pixel : image.pixels) sum += glm::dvec3(pixel);
    return sum / double(image.pixels.size());
}

TEST_F(Sdf, lightsTheSceneAsItsTrianglesDo) {
    const glm::dvec3 triangles = mean(render(lit({}))), primitives = mean(render(lit({"--sdf", file()})));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(primitives[c] / triangles[c], 1, 0.04) << c;
}

TEST_F(Sdf, isTheSameOnVulkan) {
    const std::vector<std::string> few{"--sdf", file(), "--probes", "4x4x4", "--frames", "2", "--rays", "32"};
    std::vector<std::string> gpu = few;
    gpu.insert(gpu.end(), {"--backend", "vulkan"});
    const glm::dvec3 ours = mean(render(few)), theirs = mean(render(gpu));
    EXPECT_NEAR(ours.x / theirs.x, 1, 1e-4);
}

// The preset is its options, each of which may be given otherwise.
TEST_F(Sdf, theMethodIsItsOptions) {
    const std::vector<std::string> few{"--sdf", file(), "--probes", "6x6x6", "--frames", "4", "--rays", "32"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), few.begin(), few.end());
        return render(more).pixels;
    };
    const auto preset = with({"--method", "sdfddgi"});
    EXPECT_EQ(preset, with({"--leak-guard", "sdf-shadow", "--relocation", "on", "--contact", "on"}));
    EXPECT_EQ(with({"--method", "sdfddgi", "--leak-guard", "moments", "--relocation", "off", "--contact", "off"}),
              with({}));
    EXPECT_NE(with({"--leak-guard", "sdf-shadow"}), with({}));
    EXPECT_NE(with({"--leak-guard", "sdf-shadow", "--probe-rays", "mesh"}), with({"--leak-guard", "sdf-shadow"}));
}

TEST_F(Sdf, whatNeedsPrimitivesSaysSo) {
    const auto complaint = [&](const std::vector<std::string>& more) {
        const ToolRun run = runTool(arguments(more));
        EXPECT_NE(run.exitCode, 0);
        return run.err;
    };
    EXPECT_THAT(complaint({"--method", "sdfddgi"}), HasSubstr("sdfddgi needs the primitives of --sdf FILE"));
    EXPECT_THAT(complaint({"--leak-guard", "sdf-shadow"}), HasSubstr("needs the primitives of --sdf FILE"));
    EXPECT_THAT(complaint({"--sdf", file(), "--leak-guard", "sdf-shadow", "--method", "leaky"}),
                HasSubstr("with --method ddgi only"));
    EXPECT_THAT(complaint({"--probe-rays", "mesh"}), HasSubstr("without --sdf FILE"));
}

TEST_F(Sdf, animationsSayWhenNoPrimitiveMoves) {
    const auto warning = [&](const std::string& primitives) {
        writeText(file("m.sdf.json"), primitives);
        const ToolRun run =
            runTool({"render", "builtin:moving", "-o", file("m%d.exr"), "--animate", "0:1:1", "--size", "16x9", "--sdf",
                     file("m.sdf.json"), "--probes", "3x3x3", "--rays", "16", "--frames", "1"});
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return run.err;
    };
    const std::string ground = R"({"sdf": 1, "primitives": [{"shape": "plane", "centre": [0, 0, 0]}]})";
    EXPECT_THAT(warning(ground), HasSubstr("all that moves stays where it was fitted"));
}

/// A floor of 2 x 2 m, and a camera that rises from 2 to 3 m in a second.
std::string floorUnderAMovingCamera() {
    const nlohmann::json scene = {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0, 1}}}}},
        {"nodes",
         {{{"mesh", 0}, {"translation", {-1, 0, -1}}, {"scale", {2, 1, 2}}},
          {{"camera", 0}, {"translation", {0, 3, 0}}, {"rotation", {-0.7071068, 0, 0, 0.7071068}}}}},
        {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", 5}}}}}}},
        {"animations",
         {{{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
           {"samplers", {{{"input", 1}, {"output", 2}}}}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
          {{"bufferView", 1}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}, {"min", {0}}, {"max", {1}}},
          {{"bufferView", 2}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteLength", 48}},
          {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 8}},
          {{"buffer", 0}, {"byteOffset", 56}, {"byteLength", 24}}}},
        // (0,0,0) (0,0,1) (1,0,0) (1,0,1); 0, 1; (0,2,0) (0,3,0)
        {"buffers",
         {{{"byteLength", 80},
           {"uri",
            "data:application/octet-stream;base64,"
            "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAAAACAPwAAAAAA"
            "AIA/AAAAAAAAgD8AAAAAAAAAQAAAAAAAAAAAAABAQAAAAAA="}}}}};
    return scene.dump();
}

TEST_F(Sdf, aCameraThatMovesLeavesPrimitivesWhereTheyWere) {
    writeText(file("floor.gltf"), floorUnderAMovingCamera());
    writeText(file("m.sdf.json"), R"({"sdf": 1, "primitives": [{"shape": "plane", "centre": [0, 0, 0]}]})");
    const ToolRun run = runTool({"render", file("floor.gltf"), "-o", file("m%d.exr"), "--animate", "0:1:1", "--size",
                                 "16x9", "--sdf", file("m.sdf.json"), "--volume", "-2,-0.5,-2:2:3x3x3", "--rays", "16",
                                 "--frames", "1", "--sky", "1,1,1"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.err, testing::Not(HasSubstr("stays where it was fitted")));
}

// Files keep no primitives; who has both may look up with their shadows.
TEST_F(Sdf, shadowsOfPrimitivesOnAFieldFromAFile) {
    const std::string field = file("box.field");
    const ToolRun baked = runTool({"bake", "builtin:cornell", "-o", field, "--leak-guard", "moments", "--probes",
                                   "6x6x6", "--rays", "32", "--frames", "4"});
    ASSERT_EQ(baked.exitCode, 0) << baked.err;
    const std::vector<std::string> both{"--field", field, "--sdf", file()};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), both.begin(), both.end());
        return render(more).pixels;
    };
    const auto shadowed = with({"--leak-guard", "sdf-shadow"});
    EXPECT_NE(shadowed, with({}));
    EXPECT_EQ(shadowed, with({"--method", "sdfddgi", "--contact", "off"}));
    expectRefused({"render", "builtin:cornell", "-o", file("b.png"), "--field", field, "--leak-guard", "sdf-shadow"},
                  "--sdf FILE", 2);
}

TEST_F(Sdf, statsSayHowManyAndHowLarge) {
    const ToolRun run =
        runTool(arguments({"--sdf", file(), "--frames", "1", "--probes", "3x3x3", "--stats", file("s.json")}));
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const auto stats = nlohmann::json::parse(readText(file("s.json")));
    EXPECT_EQ(stats["primitives"], 8);
    EXPECT_EQ(stats["primitiveBytes"], 384);
}

TEST_F(Sdf, debugShowsEachPrimitiveInAColour) {
    const HdrImage shown = render({"--debug", "sdf", "--sdf", file()});
    std::set<int> hues;
    for (const glm::vec3& pixel : shown.pixels) {
        const float most = std::max({pixel.x, pixel.y, pixel.z});
        if (most > 0) hues.insert(int(16 * pixel.x / most) * 256 + int(16 * pixel.y / most));
    }
    EXPECT_GE(hues.size(), 7u);
    expectRefused({"render", "builtin:cornell", "-o", file("b.png"), "--debug", "sdf"}, "--sdf FILE", 2);
}

TEST_F(Sdf, updatesAreMeasuredWithPrimitives) {
    const ToolRun run = runTool({"bench", "builtin:cornell", "--sdf", file(), "--probes", "3x3x3", "--rays", "16",
                                 "--size", "16x9", "--rounds", "1", "--no-growth"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    expectRefused({"bench", "--sdf", file(), "--backend", "vulkan"}, "--backend cpu only", 2);
}

// Pictures show the triangles, wherever the camera is.
TEST_F(Sdf, aCameraInsideAPrimitiveSeesTheScene) {
    writeText(file("solid.json"), R"({"sdf": 1, "primitives": [
        {"shape": "box", "centre": [2.7, 2.7, 8], "halfSize": [2, 2, 2]}]})");
    const std::vector<std::string> few{"--probes", "4x4x4", "--frames", "1", "--aov", "direct"};
    std::vector<std::string> within = few;
    within.insert(within.end(), {"--sdf", file("solid.json")});
    EXPECT_EQ(render(few).pixels, render(within).pixels);
}

TEST_F(Sdf, movesWithTheSceneOfAnAnimation) {
    const ToolRun run = runTool({"render", "builtin:door", "-o", file("door%02d.png"), "--animate", "0:1:1", "--sdf",
                                 file(), "--size", "16x9", "--probes", "3x3x3", "--rays", "16", "--frames", "2"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
}

TEST_F(Sdf, noPrimitivesAreAWarning) {
    writeText(file("none.json"), R"({"sdf": 1, "primitives": []})");
    const ToolRun run = runTool(arguments({"--sdf", file("none.json"), "--frames", "1", "--probes", "3x3x3"}));
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_THAT(run.err, HasSubstr("has no primitives: the rays of probes meet only the sky"));
    const ToolRun mesh =
        runTool(arguments({"--sdf", file("none.json"), "--probe-rays", "mesh", "--frames", "1", "--probes", "3x3x3"}));
    EXPECT_EQ(mesh.exitCode, 0);
    EXPECT_THAT(mesh.err, HasSubstr("has no primitives: they shade nothing"));
}

TEST_F(Sdf, wrongFilesAreRefused) {
    const auto refused = [&](const std::string& name, const std::string& words) {
        expectRefused({"render", "builtin:cornell", "-o", file("b.png"), "--sdf", file(name)}, words, 1);
    };
    refused("absent.json", "absent.json");
    writeText(file("typo.json"), R"({"sdf": 1, "primitives": [{"shape": "boks", "centre": [0, 0, 0]}]})");
    refused("typo.json", "there is no shape 'boks'");
    writeText(file("node.json"),
              R"({"sdf": 1, "primitives": [{"shape": "plane", "centre": [0, 0, 0], "node": "nowhere"}]})");
    refused("node.json", "rides on node 'nowhere', which the scene does not have");
    expectRefused({"render", "builtin:cornell", "-o", file("b.png"), "--sdf", file(), "--stats", file()},
                  "would overwrite", 1);
}

}  // namespace
}  // namespace probegi::test
