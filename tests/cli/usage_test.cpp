#include <gmock/gmock.h>

#include "cli/tool.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

class BadValue : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(BadValue, IsRefusedWithOneSentenceThatNamesTheOption) {
    const auto& [option, value] = GetParam();
    const TemporaryFolder folder;
    expectRefused({"render", "builtin:cornell", "-o", folder.file("a.png"), option, value}, option, 2);
    EXPECT_EQ(folder.entries(), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Render, BadValue,
    testing::Values(std::pair{"--method", "magic"}, std::pair{"--size", "0x10"}, std::pair{"--size", "16385x10"},
                    std::pair{"--size", "32"}, std::pair{"--size", "axb"}, std::pair{"--probes", "8x8"},
                    std::pair{"--probes", "1x8x8"}, std::pair{"--probes", "1024x1024x1024"}, std::pair{"--rays", "7"},
                    std::pair{"--rays", "4097"}, std::pair{"--rays", "many"}, std::pair{"--frames", "0"},
                    std::pair{"--frames", "-3"}, std::pair{"--spp", "0"}, std::pair{"--spp", "2.5"},
                    std::pair{"--time", "0"}, std::pair{"--time", "nan"}, std::pair{"--seed", "-1"},
                    std::pair{"--seed", "x"}, std::pair{"--threads", "-1"}, std::pair{"--threads", "1025"},
                    std::pair{"--aov", "beauty"}, std::pair{"--glossy", "mirror"}, std::pair{"--exposure", "0"},
                    std::pair{"--exposure", "inf"}, std::pair{"--exposure", "bright"}, std::pair{"--antialias", "9"},
                    std::pair{"--sun", "0,-1,0"}, std::pair{"--sun", "0,0,0,5"}, std::pair{"--sun", "0,-1,0,-5"},
                    std::pair{"--sun", "0,-1,0,nan"}, std::pair{"--sun", "0,-1,0,1e30"}, std::pair{"--point", "1,2,3"},
                    std::pair{"--point", "1,2,3,-1,0,0"}, std::pair{"--point", "1,2,3,a,0,0"},
                    std::pair{"--look-from", "1,2"}, std::pair{"--look-at", "1,2,"}, std::pair{"--fov", "0"},
                    std::pair{"--fov", "180"}, std::pair{"--volume", "0,0,0:1"}, std::pair{"--volume", "0,0,0:0:4x4x4"},
                    std::pair{"--volume", "0,0,0:1:1x4x4"}, std::pair{"--volume", "0,0:1:4x4x4"},
                    std::pair{"--time-of-scene", "late"}, std::pair{"--wall", "1"}, std::pair{"--albedo", "1"},
                    std::pair{"--emission", "-1"}, std::pair{"--power", "0"}, std::pair{"--radius", "0"},
                    std::pair{"--unpack-limit", "0"}, std::pair{"--unpack-limit", "1.5"},
                    std::pair{"--unpack-limit", "-5"}, std::pair{"--cascades", "0"}, std::pair{"--cascades", "9"},
                    std::pair{"--outside", "far"}, std::pair{"--outside", "-1,0,0"}, std::pair{"--debug", "walls"},
                    std::pair{"--budget", "0"}, std::pair{"--budget", "-5"}, std::pair{"--budget", "fast"},
                    std::pair{"--budget", "0ms"}, std::pair{"--budget", "nanms"}, std::pair{"--budget", "4s"},
                    std::pair{"--backend", "cuda"}, std::pair{"--tracer", "embree"}),
    [](const auto& instance) {
        std::string name = instance.param.first + "_" + std::to_string(instance.index);
        std::erase_if(name, [](char c) { return c == '-'; });
        return name;
    });

TEST(Usage, UnknownOptionsAndCommandsAreRefused) {
    expectRefused({"render", "builtin:cornell", "-o", "a.png", "--frobnicate"}, "--frobnicate", 2);
    expectRefused({"paint"}, "paint", 2);
    expectRefused({"--frobnicate"}, "--frobnicate", 2);
    expectRefused({"scenes", "extra"}, "extra", 2);
}

TEST(Usage, CascadesAndDebugViewsThatCannotBeAreRefused) {
    const auto refused = [](std::vector<std::string> options, const std::string& mentions, int exitCode) {
        const TemporaryFolder folder;
        options.insert(options.begin(), {"render", "builtin:cornell", "-o", folder.file("a.png")});
        expectRefused(options, mentions, exitCode);
    };
    refused({"--cascades", "2", "--probes", "4x4x4"}, "--probes", 2);
    refused({"--cascades", "2", "--volume", "0,0,0:1:4x4x4"}, "--volume", 2);
    refused({"--cascade-spacing", "1"}, "--cascades", 2);
    refused({"--cascade-probes", "8x8x8"}, "--cascades", 2);
    refused({"--cascades", "2", "--cascade-spacing", "0"}, "--cascade-spacing", 2);
    refused({"--cascades", "2", "--cascade-probes", "8x4x8"}, "counts is 4", 1);
    refused({"--debug", "volumes", "--method", "none"}, "--debug", 2);
    refused({"--debug", "volumes", "--method", "reference"}, "--debug", 2);
    refused({"--budget", "20000"}, "--frames", 2);
    refused({"--budget", "20000", "--frames", "2", "--method", "none"}, "--budget", 2);
    refused({"--budget", "10", "--frames", "2"}, "does not pay for one probe", 1);
}

TEST(Usage, ALayerOfGlossyLightTakesAPictureThatHasIt) {
    const TemporaryFolder folder;
    const std::vector<std::string> command{"render", "builtin:mirrors", "-o", folder.file("a.png"), "--aov", "glossy"};
    const auto refused = [&](std::vector<std::string> options) {
        options.insert(options.begin(), command.begin(), command.end());
        expectRefused(options, "--glossy", 2);
    };
    refused({});
    refused({"--glossy", "off"});
    refused({"--glossy", "field", "--method", "reference"});
    refused({"--glossy", "field", "--diffuse-only"});
}

TEST(Usage, LayersOfContactLightTakeAPictureThatHasThem) {
    const TemporaryFolder folder;
    for (const char* layer : {"contact", "openness"}) {
        const std::vector<std::string> command{"render", "builtin:desk", "-o", folder.file("a.png"), "--aov", layer};
        const auto refused = [&](std::vector<std::string> options) {
            options.insert(options.begin(), command.begin(), command.end());
            expectRefused(options, "--contact", 2);
        };
        refused({});
        refused({"--contact", "off"});
        refused({"--contact", "on", "--method", "reference"});
        refused({"--contact", "maybe"});
    }
}

TEST(Usage, MissingArgumentsAreNamed) {
    expectRefused({"render", "-o", "a.png"}, "SCENE", 2);
    expectRefused({"render", "builtin:cornell"}, "--output", 2);
    expectRefused({"render", "builtin:cornell", "-o"}, "--output", 2);
    expectRefused({"compare", "a.exr"}, "B", 2);
    expectRefused({"info"}, "SCENE", 2);
}

TEST(Usage, ProbesAndVolumeExcludeEachOther) {
    expectRefused({"render", "builtin:cornell", "-o", "a.png", "--probes", "4x4x4", "--volume", "0,0,0:1:4x4x4"},
                  "--probes", 2);
}

TEST(Usage, HelpHasAnExample) {
    for (const char* command : {"render", "compare", "info", "scenes", "bench", "report", "devices"}) {
        const ToolRun run = runTool({command, "--help"});
        EXPECT_EQ(run.exitCode, 0) << command;
        EXPECT_THAT(run.out, HasSubstr("Example: probegi ")) << command;
        EXPECT_EQ(run.err, "") << command;
    }
}

TEST(Usage, MainHelpShowsAFirstCommand) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, std::vector<std::string>{}}) {
        const ToolRun run = runTool(arguments);
        EXPECT_EQ(run.exitCode, 0);
        EXPECT_THAT(run.out, HasSubstr("What to type first"));
        EXPECT_THAT(run.out, HasSubstr("Example"));
    }
}

TEST(Usage, HelpOfRenderListsEveryOption) {
    const std::string help = runTool({"render", "--help"}).out;
    for (const char* option :
         {"--output",        "--method",       "--size",      "--camera",       "--probes",   "--rays",     "--frames",
          "--spp",           "--time",         "--seed",      "--threads",      "--aov",      "--exposure", "--sun",
          "--point",         "--sky",          "--look-from", "--look-at",      "--fov",      "--volume",   "--stats",
          "--time-of-scene", "--diffuse-only", "--wall",      "--albedo",       "--emission", "--backend",  "--device",
          "--tracer",        "--shader-cache", "--tolerance", "--unpack-limit", "--glossy"})
        EXPECT_THAT(help, HasSubstr(option));
}

TEST(Usage, Version) {
    const ToolRun run = runTool({"--version"});
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_THAT(run.out, testing::MatchesRegex("probegi [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Runtime, BadFilesAreRefusedBeforeAnythingIsWritten) {
    const TemporaryFolder folder;
    const std::string out = folder.file("a.png");
    expectRefused({"render", "nowhere.glb", "-o", out}, "nowhere.glb", 1);
    expectRefused({"render", "builtin:nothing", "-o", out}, "nothing", 1);
    expectRefused({"info", "nowhere.glb"}, "nowhere.glb", 1);
    expectRefused({"render", "builtin:cornell", "-o", folder.file("a.bmp")}, ".png or .exr", 1);
    expectRefused({"render", "builtin:cornell", "-o", folder.file("a")}, ".png or .exr", 1);
    expectRefused({"render", "builtin:cornell", "-o", folder.file("none/a.png")}, "does not exist", 1);
    expectRefused({"render", "builtin:cornell", "-o", out, "--stats", folder.file("none/s.json")}, "does not exist", 1);
    expectRefused({"render", "builtin:cornell", "-o", out, "--camera", "backdoor"}, "backdoor", 1);
    expectRefused({"render", "builtin:cornell", "-o", out, "--camera", "99"}, "99", 1);
    expectRefused({"render", "builtin:cornell", "-o", out, "--sky", "blue"}, "--sky", 1);
    expectRefused({"render", "builtin:cornell", "-o", out, "--sky", "-1,0,0"}, "negative", 1);
    expectRefused({"render", "builtin:cornell", "-o", out, "--look-from", "1,1,1", "--look-at", "1,1,1"}, "--look-at",
                  1);
    expectRefused({"compare", "nowhere.exr", "nowhere.exr"}, "nowhere.exr", 1);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(Runtime, MalformedSceneIsOneSentence) {
    const TemporaryFolder folder;
    writeText(folder.file("bad.gltf"), "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"mesh\": 7}]}");
    expectRefused({"render", folder.file("bad.gltf"), "-o", folder.file("a.png")}, "bad.gltf", 1);
    writeText(folder.file("bad.glb"), "glTF but no more");
    expectRefused({"info", folder.file("bad.glb")}, "bad.glb", 1);
    EXPECT_EQ(folder.entries(), 2u);
}

}  // namespace
}  // namespace probegi::test
