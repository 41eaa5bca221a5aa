#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

// A square floor of one metre without any light, with positions in a data URI.
constexpr const char* kUnlitFloor = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

// A tiny render; expects success without any output.
HdrImage render(std::vector<std::string> arguments, const std::string& scene = "builtin:cornell") {
    const TemporaryFolder folder;
    const std::string out = folder.file("a.exr");
    arguments.insert(arguments.begin(), {"render", scene, "-o", out, "--size", "32x18"});
    const ToolRun run = runTool(arguments);
    EXPECT_EQ(run.exitCode, 0) << testing::PrintToString(arguments);
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(run.out, "");
    const auto image = readImage(out);
    EXPECT_TRUE(image) << testing::PrintToString(arguments);
    EXPECT_EQ(folder.entries(), 1u);
    if (!image) return {};
    EXPECT_EQ(image->width, 32);
    EXPECT_EQ(image->height, 18);
    return *image;
}

double mean(const HdrImage& image) {
    double sum = 0;
    for (const glm::vec3& pixel : image.pixels) sum += pixel.x + pixel.y + pixel.z;
    return sum / double(3 * image.pixels.size());
}

const std::vector<std::string> kQuick{"--frames", "2", "--probes", "4x4x4", "--rays", "32", "--antialias", "1"};

std::vector<std::string> quick(std::vector<std::string> more) {
    more.insert(more.end(), kQuick.begin(), kQuick.end());
    return more;
}

TEST(Render, ThePapersRulesMakeAnotherPicture) {
    const HdrImage measured = render(quick({"--rules", "measured"})), paper = render(quick({"--rules", "paper"}));
    EXPECT_EQ(measured.pixels, render(quick({})).pixels);
    EXPECT_NE(measured.pixels, paper.pixels);
    EXPECT_NEAR(mean(paper) / mean(measured), 1, 0.3);
}

TEST(Render, EveryMethodMakesAPicture) {
    const double none = mean(render({"--method", "none"}));
    const double ddgi = mean(render(quick({"--method", "ddgi"})));
    const double leaky = mean(render(quick({"--method", "leaky"})));
    const double reference = mean(render({"--method", "reference", "--spp", "2"}));
    EXPECT_GT(none, 0);
    EXPECT_GT(ddgi, none);
    EXPECT_GT(leaky, none);
    EXPECT_GT(reference, none);
}

// A tiny render of which a warning is no failure: of surfaces where there are no probes.
HdrImage renderWarned(std::vector<std::string> arguments) {
    const TemporaryFolder folder;
    const std::string out = folder.file("a.exr");
    arguments.insert(arguments.begin(), {"render", "builtin:cornell", "-o", out, "--size", "32x18"});
    EXPECT_EQ(runTool(arguments).exitCode, 0) << testing::PrintToString(arguments);
    return readImage(out).value();
}

// From inside the box.
const std::vector<std::string> kInside{"--look-from", "4,2.7,-1"};

std::vector<std::string> inside(std::vector<std::string> more) {
    more.insert(more.end(), kInside.begin(), kInside.end());
    return more;
}

std::vector<std::string> cascades(std::vector<std::string> more) {
    more.insert(more.end(), {"--cascades", "2", "--cascade-probes", "12x12x12", "--frames", "3", "--rays", "32"});
    return inside(more);
}

TEST(Render, CascadesLightAScene) {
    const double grid =
        mean(render(inside({"--aov", "indirect", "--probes", "10x10x10", "--frames", "3", "--rays", "32"})));
    EXPECT_NEAR(mean(render(cascades({"--aov", "indirect"}))) / grid, 1.0, 0.4);
    // Small ones around the camera: what lies beyond is as bright as it is told to be.
    const auto beyond = [&](const char* radiance) {
        return mean(
            renderWarned(cascades({"--aov", "irradiance", "--cascade-spacing", "0.01", "--outside", radiance})));
    };
    EXPECT_EQ(beyond("0,0,0"), 0.0);
    EXPECT_NEAR(beyond("3,3,3") / beyond("1,1,1"), 3.0, 1e-3);
}

TEST(Render, DebugViewsShowVolumesAndWhatTheyCover) {
    // Reddish, greenish... of the surfaces; the sky is black.
    const auto hues = [](const HdrImage& image) {
        std::set<std::array<int, 3>> found;
        for (const glm::vec3& pixel : image.pixels)
            if (const float most = std::max({pixel.x, pixel.y, pixel.z}); most > 0)
                found.insert({int(8 * pixel.x / most), int(8 * pixel.y / most), int(8 * pixel.z / most)});
        return found.size();
    };
    const HdrImage one = render({"--debug", "volumes", "--probes", "4x4x4"});
    EXPECT_LE(hues(one), 3u) << "one volume has one colour";
    EXPECT_GE(hues(renderWarned(cascades({"--debug", "volumes"}))), hues(one) + 2) << "two, and what is between them";
    const HdrImage weights = render({"--debug", "weights", "--probes", "4x4x4", "--frames", "2"});
    EXPECT_GE(hues(weights), 20u) << "of 64 probes, and mixtures of them";
    const HdrImage covered = render({"--debug", "coverage", "--probes", "4x4x4"}),
                   away = renderWarned({"--debug", "coverage", "--volume", "50,0,0:1:3x3x3"});
    for (std::size_t i = 0; i < covered.pixels.size(); ++i) {
        EXPECT_GE(covered.pixels[i].y, covered.pixels[i].x) << "green";
        EXPECT_GE(away.pixels[i].x, away.pixels[i].y) << "red";
    }
    EXPECT_GT(mean(covered), 0.01);
    EXPECT_GT(mean(away), 0.01);
}

TEST(Render, DebugViewsShowProbesByWhatTheyDo) {
    const auto count = [](const HdrImage& image, const auto& is) {
        return std::count_if(image.pixels.begin(), image.pixels.end(), is);
    };
    const auto blue = [](glm::vec3 p) { return p.z > 2 * p.x && p.z > 1.5f * p.y; };
    const auto green = [](glm::vec3 p) { return p.y > 2 * p.x && p.y > 2 * p.z; };
    const auto red = [](glm::vec3 p) { return p.x > 2 * p.y && p.x > 2 * p.z; };
    const std::vector<std::string> states{"--debug", "states", "--probes", "10x10x10", "--frames", "1"};
    const HdrImage all = render(states);
    EXPECT_GT(count(all, green), 10);
    EXPECT_EQ(count(all, blue), 0) << "nobody sleeps";
    std::vector<std::string> some = states;
    some.insert(some.end(), {"--probe-states", "on"});
    EXPECT_GT(count(render(some), blue), 0);
    std::vector<std::string> offsets{"--debug", "offsets", "--probes", "10x10x10", "--frames", "1"};
    EXPECT_EQ(count(render(offsets), red), 0) << "all on the grid";
    offsets.insert(offsets.end(), {"--relocation", "on"});
    EXPECT_GT(count(render(offsets), red), 0);
}

TEST(Render, ABudgetLimitsUpdatesAndDebugViewsShowIt) {
    const auto count = [](const HdrImage& image, const auto& is) {
        return std::count_if(image.pixels.begin(), image.pixels.end(), is);
    };
    const auto green = [](glm::vec3 p) { return p.y > 2 * p.x && p.y > 1.5f * p.z; };
    const auto red = [](glm::vec3 p) { return p.x > 2 * p.y && p.x > 2 * p.z; };
    const std::vector<std::string> grid{"--probes", "10x10x10", "--frames", "3", "--rays", "16", "--seed", "3"};
    const auto with = [&](std::vector<std::string> options) {
        options.insert(options.end(), grid.begin(), grid.end());
        return options;
    };
    EXPECT_EQ(count(render(with({"--debug", "age"})), red), 0) << "all have just been updated";
    EXPECT_GT(count(render(with({"--debug", "age"})), green), 10);
    // 36 rays a probe: 200 of them an update, none yet twice.
    const HdrImage ages = render(with({"--debug", "age", "--budget", "7200"}));
    EXPECT_LT(count(ages, green), count(render(with({"--debug", "age"})), green));
    EXPECT_GT(count(render(with({"--debug", "confidence"})), red), 10) << "windows are short at first";

    const TemporaryFolder folder;
    for (const char* budget : {"7200", "0.001ms", "7500"}) {
        std::vector<std::string> words{"render",   "builtin:cornell",
                                       "-o",       folder.file("a.png"),
                                       "--size",   "32x18",
                                       "--stats",  folder.file("s.json"),
                                       "--budget", budget};
        words.insert(words.end(), grid.begin(), grid.end());
        const ToolRun run = runTool(words);
        ASSERT_EQ(run.exitCode, 0) << run.err;
        const auto stats = nlohmann::json::parse(readText(folder.file("s.json")));
        EXPECT_EQ(stats["activeProbes"], 1000);
        if (std::string(budget) == "0.001ms")
            EXPECT_LE(stats["updatedProbes"].get<double>(), (64 + 1 + 1) / 3.0) << "64 before it knows what they cost";
        else
            EXPECT_EQ(stats["updatedProbes"], std::string(budget) == "7200" ? 200 : 208);
    }
}

TEST(Render, UntilConverged) {
    EXPECT_GT(mean(render({"--probes", "6x6x6", "--rays", "32"}, "builtin:furnace")), 0);
}

TEST(Render, ReferenceStopsAfterATime) {
    EXPECT_GT(mean(render({"--method", "reference", "--time", "0.2"})), 0);
}

TEST(Render, EveryLayer) {
    for (const char* layer : {"irradiance", "normal", "albedo", "depth", "direct", "indirect", "color"}) {
        const HdrImage image = render(quick({"--aov", layer}));
        double magnitude = 0;
        for (const glm::vec3& p : image.pixels) magnitude += std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
        EXPECT_GT(magnitude, 0) << layer;
    }
}

TEST(Render, LayersAddUp) {
    const HdrImage color = render(quick({})), direct = render(quick({"--aov", "direct"})),
                   indirect = render(quick({"--aov", "indirect"})), depth = render(quick({"--aov", "depth"}));
    for (std::size_t i = 0; i < color.pixels.size(); ++i) {
        if (depth.pixels[i].x > 0) {
            EXPECT_EQ(color.pixels[i], direct.pixels[i] + indirect.pixels[i]);
        }
    }
}

TEST(Render, GlossyLightIsPartOfTheIndirectAndTimed) {
    const TemporaryFolder folder;
    const std::vector<std::string> mirrors{"--glossy", "field", "--frames", "3", "--probes", "4x4x4"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), mirrors.begin(), mirrors.end());
        return mean(render(more, "builtin:mirrors"));
    };
    const double glossy = with({"--aov", "glossy", "--stats", folder.file("s.json")});
    EXPECT_GT(glossy, 0.01);
    EXPECT_LT(glossy, with({"--aov", "indirect"}));
    EXPECT_GT(nlohmann::json::parse(readText(folder.file("s.json")))["glossyMs"], 0);
}

TEST(Render, ContactLightDarkensNooksAndIsTimed) {
    const TemporaryFolder folder;
    const std::vector<std::string> desk{"--frames", "3", "--probes", "4x4x4"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), desk.begin(), desk.end());
        return mean(render(more, "builtin:desk"));
    };
    const double off = with({"--aov", "irradiance"});
    const double on = with({"--aov", "irradiance", "--contact", "on", "--stats", folder.file("s.json")});
    EXPECT_LT(on, off);
    EXPECT_GT(on, 0.8 * off);
    EXPECT_GT(with({"--aov", "contact", "--contact", "on"}), 0.0);
    const double open = with({"--aov", "openness", "--contact", "on"});
    EXPECT_GT(open, 0.7);
    EXPECT_LT(open, 0.99);
    EXPECT_GT(nlohmann::json::parse(readText(folder.file("s.json")))["contactMs"], 0);
}

TEST(Render, ThreadsDoNotChangeThePictureAndSeedsDo) {
    const auto pixels = [](std::vector<std::string> options) { return render(quick(std::move(options))).pixels; };
    const auto one = pixels({"--threads", "1"});
    EXPECT_TRUE(one == pixels({"--threads", "2"}));
    EXPECT_FALSE(one == pixels({"--threads", "1", "--seed", "2"}));
}

TEST(Render, OverridesReplaceWhatTheSceneSays) {
    const std::vector<std::string> none{"--method", "none"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), none.begin(), none.end());
        return mean(render(std::move(more)));
    };
    const double plain = with({});
    for (const std::vector<std::string>& change :
         std::vector<std::vector<std::string>>{{"--sun", "-0.2,-1,-0.9,50"},
                                               {"--point", "0.5,0.5,0.5,5,6,7"},
                                               {"--point", "0.5,0.5,0.5,5,6,7", "--point", "1,1,1,5,6,7"},
                                               {"--sky", "5,6,7"},
                                               {"--camera", "0", "--fov", "20"},
                                               {"--look-from", "0.3,3.5,0.2", "--look-at", "0.1,0.2,0.3"},
                                               {"--diffuse-only", "--aov", "depth"}})
        EXPECT_NE(with(change), plain) << testing::PrintToString(change);
}

TEST(Render, BuiltinParametersAndVolume) {
    const double dim = mean(render({"--method", "none", "--emission", "1"}, "builtin:furnace"));
    const double bright = mean(render({"--method", "none", "--emission", "4"}, "builtin:furnace"));
    EXPECT_NEAR(bright, 4 * dim, 1e-4 * bright);
    EXPECT_GT(
        mean(render({"--volume", "-1,-1,-6.5:1:8x8x8", "--frames", "1", "--rays", "8", "--time-of-scene", "0.5"})), 0);
    EXPECT_GT(mean(render({"--method", "none", "--wall", "0.2"}, "builtin:two-rooms")), 0);
}

TEST(Render, PngFollowsExposure) {
    const TemporaryFolder folder;
    const auto png = [&](const std::string& exposure, bool filmic) {
        std::vector<std::string> arguments{"render", "builtin:cornell", "-o",   folder.file("a.png"), "--size",
                                           "32x18",  "--method",        "none", "--exposure",         exposure};
        if (filmic) arguments.push_back("--filmic");
        EXPECT_EQ(runTool(arguments).exitCode, 0);
        return mean(readImage(folder.file("a.png")).value());
    };
    const double dark = png("0.01", false);
    EXPECT_LT(dark, png("0.02", false));
    EXPECT_NE(png("0.5", false), png("0.5", true));
}

TEST(Render, AutomaticExposureIsPrintedAndFollowsTheLight) {
    const TemporaryFolder folder;
    const auto png = [&](const std::string& emission, std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "builtin:furnace", "-o", folder.file("a.png"), "--size", "32x18",
                                   "--method", "none", "--emission", emission});
        const ToolRun run = runTool(more);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return std::pair(run.out, mean(readImage(folder.file("a.png")).value()));
    };
    // Without bounces, every pixel of a furnace is its emission, which automatic exposure maps to 0.18.
    const auto [saidDim, dim] = png("0.01", {});
    const auto [saidBright, bright] = png("100", {});
    EXPECT_THAT(saidDim, HasSubstr("--exposure 18\n"));
    EXPECT_THAT(saidBright, HasSubstr("--exposure 0.0018\n"));
    EXPECT_NEAR(dim, 0.18, 2e-3);
    EXPECT_NEAR(bright, 0.18, 2e-3);
    const auto [saidFixed, fixed] = png("0.5", {"--exposure", "1"});
    EXPECT_EQ(saidFixed, "");
    EXPECT_NEAR(fixed, 0.5, 5e-3);
    // The scene suggests an exposure of 0.5 (1 - albedo) / emission, and its albedo is a half.
    const auto [saidScene, scene] = png("3", {"--exposure", "scene"});
    EXPECT_EQ(saidScene, "");
    EXPECT_NEAR(scene, 0.25, 5e-3);
}

TEST(Render, ANearlyBlackPictureIsReported) {
    const TemporaryFolder folder;
    const auto said = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "builtin:cornell", "--size", "32x18", "--method", "none", "-o"});
        const ToolRun run = runTool(more);
        EXPECT_EQ(run.exitCode, 0);
        return run.err;
    };
    const std::string dark = said({folder.file("a.png"), "--exposure", "1e-6"});
    EXPECT_THAT(dark, HasSubstr("warning: 100 % of '" + folder.file("a.png") + "' is nearly black at exposure 1e-06"));
    EXPECT_THAT(dark, HasSubstr("--look-from"));
    EXPECT_EQ(said({folder.file("a.png"), "--aov", "albedo"}), "") << "no light, no warning";
    EXPECT_EQ(said({folder.file("a.exr")}), "") << "linear light has no exposure";
}

// With eight rays per probe, Cornell does not converge to 0.01 % in 128 updates, but to 100 % in a few.
TEST(Render, ReachingTheCapIsReported) {
    const TemporaryFolder folder;
    const auto run = [&](const char* tolerance) {
        const ToolRun tool =
            runTool({"render", "builtin:cornell", "-o", folder.file("a.png"), "--size", "32x18", "--probes", "3x3x3",
                     "--rays", "8", "--tolerance", tolerance, "--stats", folder.file("s.json")});
        EXPECT_EQ(tool.exitCode, 0) << tool.err;
        return std::pair(tool.err, nlohmann::json::parse(readText(folder.file("s.json"))));
    };
    const auto [said, capped] = run("0.0001");
    EXPECT_THAT(said, HasSubstr("warning: the probes have not converged to 0.01 % after 128 updates"));
    EXPECT_THAT(said, HasSubstr("may still be"));
    EXPECT_EQ(capped["converged"], false);
    EXPECT_EQ(capped["frames"], 128);
    EXPECT_GT(capped["remaining"], 1e-4);
    const auto [silent, converged] = run("1");
    EXPECT_EQ(silent, "");
    EXPECT_EQ(converged["converged"], true);
    EXPECT_LT(converged["remaining"], 1);
    EXPECT_LT(converged["frames"], 128);
}

TEST(Render, AGridThatLeavesSurfacesOutIsReported) {
    const TemporaryFolder folder;
    const auto said = [&](const char* volume) {
        const ToolRun tool = runTool({"render", "builtin:furnace", "-o", folder.file("a.png"), "--size", "32x18",
                                      "--volume", volume, "--frames", "1", "--rays", "8"});
        EXPECT_EQ(tool.exitCode, 0) << tool.err;
        return tool.err;
    };
    // The furnace is 4 x 3 x 4 m around x = z = 0, its camera at (1.4, 1.6, 1.5).
    EXPECT_EQ(said("-2.5,-0.5,-2.5:1:6x5x6"), "");
    EXPECT_EQ(said("-1.5,0.5,-1.5:1:4x3x4"), "") << "half a cell between a wall and the outermost probes";
    const std::string small = said("-1,0.5,-1:0.5:3x4x3");
    EXPECT_THAT(small, HasSubstr("warning: the scene reaches 2 m beyond its probe grid"));
    EXPECT_THAT(small, HasSubstr("warning: the camera stands 1.5 m outside the probe grid"));
}

TEST(Render, StatsHaveExactlyTheirKeys) {
    const TemporaryFolder folder;
    const ToolRun run = runTool({"render", "builtin:cornell", "-o", folder.file("a.png"), "--size", "32x18", "--stats",
                                 folder.file("s.json"), "--frames", "3", "--probes", "4x5x6", "--rays", "24"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const auto stats = nlohmann::json::parse(readText(folder.file("s.json")));
    const auto keys = [](const nlohmann::json& object) {
        std::vector<std::string> names;
        for (const auto& [name, value] : object.items()) names.push_back(name);
        return names;
    };
    EXPECT_THAT(keys(stats),
                testing::UnorderedElementsAre("probes", "activeProbes", "raysPerProbe", "frames", "updatedProbes",
                                              "converged", "remaining", "updateMs", "pictureMs", "peakMemoryBytes"));
    EXPECT_THAT(keys(stats["updateMs"]), testing::UnorderedElementsAre("trace", "shade", "blend", "total"));
    EXPECT_EQ(stats["probes"], 120);
    EXPECT_EQ(stats["activeProbes"], 120);
    EXPECT_EQ(stats["raysPerProbe"], 24);
    EXPECT_EQ(stats["frames"], 3);
    EXPECT_EQ(stats["updatedProbes"], 120);
    EXPECT_TRUE(stats["converged"].is_null()) << "real-time updates do not say";
    EXPECT_GT(stats["updateMs"]["total"], 0);
    EXPECT_GT(stats["pictureMs"], 0);
    EXPECT_GT(stats["peakMemoryBytes"], 1 << 20);
    EXPECT_EQ(folder.entries(), 2u);
}

TEST(Render, ProbeStatesLeaveProbesOutThatNoSurfaceUses) {
    const TemporaryFolder folder;
    const std::vector<std::string> common{"render",   "builtin:two-rooms", "--size", "32x18", "--frames",     "2",
                                          "--probes", "14x9x10",           "--rays", "16",    "--relocation", "on"};
    const auto render = [&](const char* name, const char* states) {
        std::vector<std::string> arguments = common;
        for (const std::string& more :
             {std::string("-o"), folder.file(std::string(name) + ".png"), std::string("--stats"), folder.file("s.json"),
              std::string("--probe-states"), std::string(states)})
            arguments.push_back(more);
        const ToolRun run = runTool(arguments);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return nlohmann::json::parse(readText(folder.file("s.json")));
    };
    const auto all = render("all", "off"), some = render("some", "on");
    EXPECT_EQ(all["activeProbes"], all["probes"]);
    EXPECT_LT(some["activeProbes"], some["probes"]);
    EXPECT_GT(some["activeProbes"], 0);
}

TEST(Render, SceneWithoutLightNamesTheOptionsThatAddOne) {
    const TemporaryFolder folder;
    writeText(folder.file("dark.gltf"), kUnlitFloor);
    const std::string out = folder.file("a.png");
    const ToolRun dark = runTool({"render", folder.file("dark.gltf"), "-o", out, "--size", "32x18"});
    EXPECT_EQ(dark.exitCode, 1);
    for (const char* option : {"--sun", "--point", "--sky", "dark.gltf"}) EXPECT_THAT(dark.err, HasSubstr(option));
    EXPECT_EQ(folder.entries(), 1u);
    for (const std::vector<std::string>& light :
         std::vector<std::vector<std::string>>{{"--sun", "0,0,-1,5"}, {"--point", "0,0,1,5,5,5"}, {"--sky", "1,1,1"}}) {
        std::vector<std::string> arguments{"render", folder.file("dark.gltf"), "-o", out, "--size", "32x18"};
        arguments.insert(arguments.end(), light.begin(), light.end());
        const ToolRun lit = runTool(quick(arguments));
        EXPECT_EQ(lit.exitCode, 0) << lit.err;
    }
}

TEST(Render, AnImageAsSky) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder.file("sky.exr"), HdrImage(8, 4, glm::vec3(2, 0, 0))));
    const HdrImage image = render(
        {"--method", "none", "--sky", folder.file("sky.exr"), "--look-from", "0,500,0", "--look-at", "0,501,0.1"});
    for (const glm::vec3& pixel : image.pixels) EXPECT_EQ(pixel, glm::vec3(2, 0, 0));
}

TEST(Render, OptionsOfAnotherMethodWarn) {
    const TemporaryFolder folder;
    const ToolRun run = runTool(
        {"render", "builtin:cornell", "-o", folder.file("a.png"), "--size", "32x18", "--method", "none", "--spp", "4"});
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_THAT(run.err, testing::StartsWith("warning: "));
}

TEST(Render, DebugPicturesSayWhatTheyLeaveOut) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& option :
         std::vector<std::vector<std::string>>{{"--contact", "on"}, {"--glossy", "first"}}) {
        std::vector<std::string> arguments{"render", "builtin:cornell", "-o",       folder.file("a.png"), "--size",
                                           "32x18",  "--debug",         "coverage", "--probes",           "3x3x3"};
        arguments.insert(arguments.end(), option.begin(), option.end());
        const ToolRun run = runTool(arguments);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("--glossy and --contact do nothing with --debug"));
    }
}

}  // namespace
}  // namespace probegi::test
