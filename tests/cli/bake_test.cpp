// probegi bake, and what reads its files: render --field, info, compare.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "probegi/field_file.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

Words joined(Words first, const Words& more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

const Words kCoarse{"--factor", "4"};
const Words kFew{"--probes", "7x4x5", "--rays", "32"};
const Words kSmall{"--size", "32x18", "--camera", "dark", "--antialias", "1", "--aov", "irradiance"};

ToolRun bake(const std::string& file, const Words& more, const std::string& scene = "builtin:dark-room") {
    return runTool(joined(joined({"bake", scene, "-o", file}, kFew), more));
}

void expectBaked(const std::string& file, const Words& more, const std::string& scene = "builtin:dark-room") {
    const ToolRun run = bake(file, more, scene);
    EXPECT_EQ(run.exitCode, 0) << run.err;
}

std::vector<glm::vec3> draw(const TemporaryFolder& folder, const Words& more) {
    const std::string picture = folder.file("drawn.exr");
    const ToolRun run = runTool(joined(joined({"render", "builtin:dark-room", "-o", picture}, kSmall), more));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return readImage(picture).value().pixels;
}

TEST(ToolBake, drawsAsAFieldThatWasJustFilled) {
    const TemporaryFolder folder;
    const std::string file = folder.file("room.field");
    for (const Words& run : {Words{"--frames", "3"}, Words{"--tolerance", "0.5", "--relocation", "on"}}) {
        expectBaked(file, joined(kCoarse, run));
        EXPECT_EQ(draw(folder, {"--field", file}),
                  draw(folder, joined(joined({"--leak-guard", "masks", "--mask-factor", "4"}, kFew), run)));
        expectBaked(file, joined({"--leak-guard", "moments"}, Words{"--frames", "3"}));
        EXPECT_EQ(draw(folder, {"--field", file}), draw(folder, joined(kFew, {"--frames", "3"})));
        EXPECT_EQ(draw(folder, {"--field", file, "--method", "leaky"}).size(), 32u * 18);
    }
    // And it goes on from there.
    expectBaked(file, joined(kCoarse, {"--frames", "2"}));
    EXPECT_EQ(draw(folder, {"--field", file, "--frames", "3"}),
              draw(folder, joined({"--leak-guard", "masks", "--mask-factor", "4", "--frames", "5"}, kFew)));
}

TEST(ToolBake, equalBakesAreEqualFiles) {
    const TemporaryFolder folder;
    const std::string a = folder.file("a.field"), b = folder.file("b.field");
    expectBaked(a, {"--frames", "2", "--threads", "1"});
    expectBaked(b, {"--frames", "2", "--threads", "2"});
    EXPECT_EQ(readText(a), readText(b));
    expectBaked(b, {"--frames", "2", "--seed", "2"});
    EXPECT_NE(readText(a), readText(b));
    EXPECT_EQ(folder.entries(), 2u) << "nothing else is left";
}

TEST(ToolBake, saysWhatItMade) {
    const TemporaryFolder folder;
    const std::string file = folder.file("room.field"), stats = folder.file("stats.json");
    const ToolRun run = bake(file, {"--frames", "2", "--stats", stats});
    EXPECT_EQ(run.exitCode, 0);
    for (const char* word : {"baked", "140 in 1 volume", "2 real-time updates", "mask cells", "seconds", "memory"})
        EXPECT_THAT(run.out, HasSubstr(word));
    const auto json = nlohmann::json::parse(readText(stats));
    EXPECT_EQ(json.at("probes"), 140);
    EXPECT_EQ(json.at("updates"), 2);
    EXPECT_EQ(json.at("fileBytes"), std::filesystem::file_size(file));
    EXPECT_GT(json.at("seconds").at("masks"), 0);
    EXPECT_GT(json.at("masks").at("seconds").at("visibility"), 0);
    EXPECT_GT(json.at("peakMemoryBytes"), json.at("fieldBytes"));
    const ToolRun strict = bake(file, joined(kCoarse, {"--frames", "1", "--strict"}));
    EXPECT_EQ(strict.exitCode, 0);
    const auto info = nlohmann::json::parse(runTool({"info", file, "--json"}).out);
    EXPECT_EQ(info.at("masks").at("clusters"), 6) << "of --strict";
    EXPECT_EQ(info.at("masks").at("factor"), 4);
    EXPECT_THAT(std::string(info.at("recipe")), HasSubstr("6 clusters, factor 4, strict"));
    EXPECT_EQ(info.at("scene"), "builtin:dark-room");
    EXPECT_EQ(info.at("probes"), 140);
    EXPECT_EQ(info.at("updates"), 1);
    EXPECT_EQ(info.at("unfinished"), false);
    const ToolRun text = runTool({"info", file});
    for (const char* word : {"made by     probegi ", "7 x 4 x 5 probes", "32 rays", "masks       6 clusters"})
        EXPECT_THAT(text.out, HasSubstr(word));
}

TEST(ToolBake, comparesFields) {
    const TemporaryFolder folder;
    const std::string a = folder.file("a.field"), b = folder.file("b.field"), other = folder.file("c.field");
    expectBaked(a, {"--frames", "4"});
    expectBaked(b, {"--frames", "4", "--seed", "2"});
    const ToolRun fewer = runTool({"bake", "builtin:dark-room", "-o", other, "--frames", "1", "--probes", "5x4x5",
                                   "--rays", "32", "--leak-guard", "moments"});
    EXPECT_EQ(fewer.exitCode, 0) << fewer.err;
    const auto compare = [](const Words& files) {
        const ToolRun run = runTool(joined({"compare"}, joined(files, {"--json"})));
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    const auto same = compare({a, a});
    EXPECT_EQ(same.at("mean"), 1);
    EXPECT_EQ(same.at("rms"), 0);
    EXPECT_EQ(same.at("worst"), 0);
    EXPECT_TRUE(same.at("equalMaps"));
    EXPECT_TRUE(same.at("equalStates"));
    EXPECT_TRUE(same.at("equalMasks"));
    const auto different = compare({a, b});
    EXPECT_NEAR(different.at("mean"), 1, 0.2);
    EXPECT_GT(different.at("rms"), 0);
    EXPECT_GT(different.at("worst"), 0);
    EXPECT_FALSE(different.at("equalMaps"));
    EXPECT_THAT(runTool({"compare", a, b}).out, HasSubstr("light of all probes"));
    EXPECT_THAT(runTool({"compare", a, a}).out, HasSubstr("bits    the same; masks the same"));
    EXPECT_TRUE(same.at("equalSettings"));
    EXPECT_FALSE(different.at("equalSettings")) << "of another seed";
    expectRefused({"compare", a, other}, "probes at other places", 1);
    expectRefused({"compare", a, b, "--exposure", "2"}, "--exposure acts on pictures", 1);
    SavedField slow = loadField(a).value();
    slow.settings.hysteresis = 0.5f;
    ASSERT_TRUE(saveField(b, slow));
    EXPECT_THAT(runTool({"compare", a, b}).out, HasSubstr("bits    the same; masks the same; settings others"));
    EXPECT_THAT(runTool({"compare", a, a}).out, HasSubstr("settings the same"));
    const std::string picture = folder.file("p.png");
    ASSERT_TRUE(writeImage(picture, HdrImage(4, 4)));
    expectRefused({"compare", a, picture}, "compare two fields or two pictures", 1);
    expectRefused({"compare", a, b, "--heatmap", folder.file("h.png")}, "--heatmap shows where pictures differ", 1);
}

// Ends a bake by force once its first checkpoint is there, and goes on from that.
TEST(ToolBake, whatWasInterruptedIsTakenUp) {
    for (const std::string& run : {std::string("--frames 40"), std::string("--tolerance 0.0001 --relocation on")}) {
        const TemporaryFolder folder;
        const std::string whole = folder.file("whole.field"), cut = folder.file("cut.field");
        const std::string options = " bake builtin:dark-room --factor 3 --probes 9x6x7 --rays 64 --checkpoint 0 " + run;
        const auto shell = [](const std::string& line) { return std::system(("sh -c '" + line + "'").c_str()); };
        ASSERT_EQ(shell(PROBEGI_TOOL + options + " -o " + whole + " >/dev/null 2>&1"), 0);
        (void)shell(PROBEGI_TOOL + options + " -o " + cut + " >/dev/null 2>&1 & pid=$!; while [ ! -e " + cut +
                    ".part ] && kill -0 $pid; do :; done; kill -9 $pid; wait");
        ASSERT_FALSE(std::filesystem::exists(cut)) << "it ended before it could be interrupted";
        ASSERT_TRUE(std::filesystem::exists(cut + ".part"));
        ASSERT_EQ(shell(PROBEGI_TOOL + options + " --resume -o " + cut + " >/dev/null 2>&1"), 0);
        EXPECT_EQ(readText(cut), readText(whole));
        EXPECT_FALSE(std::filesystem::exists(cut + ".part"));
    }
}

// Its file is gone, and something that cannot be replaced in its place.
TEST(ToolBake, aCheckpointThatFailsIsAWarning) {
    for (const std::string& run : {std::string("--frames 300"), std::string("--tolerance 0.0001")}) {
        const TemporaryFolder folder;
        const std::string file = folder.file("a.field"), part = file + ".part", errors = folder.file("errors");
        const std::string line =
            std::string(PROBEGI_TOOL) +
            " bake builtin:dark-room --leak-guard moments --probes 7x4x5 --rays 32 --checkpoint 0 " + run + " -o " +
            file + " >/dev/null 2>" + errors + " & pid=$!; while [ ! -e " + part +
            " ] && kill -0 $pid; do :; done; until mkdir " + part + " 2>/dev/null; do rm -f " + part +
            "; done; wait $pid";
        EXPECT_EQ(std::system(("sh -c '" + line + "'").c_str()), 0) << readText(errors);
        const std::string told = readText(errors), warning = "the bake goes on";
        ASSERT_THAT(told, HasSubstr(warning)) << "it ended before its file could be taken away";
        EXPECT_EQ(told.find(warning), told.rfind(warning)) << "told once";
        EXPECT_EQ(runTool({"info", file}).exitCode, 0);
    }
}

TEST(ToolBake, whatIsToBeItsPartFileIsKept) {
    const TemporaryFolder folder;
    const std::string file = folder.file("foo"), part = file + ".part";
    const std::string primitives = R"({"sdf": 1, "primitives": [{"shape": "plane", "centre": [0, 0, 0]}]})";
    const auto refused = [&](const Words& more, const std::string& mentions) {
        expectRefused(joined(joined({"bake", "builtin:cornell", "-o", file, "--frames", "1"}, kFew), more), mentions,
                      1);
    };
    writeText(part, primitives);
    refused({"--sdf", part}, "foo.part' would overwrite a file that is read");
    refused({"--stats", part}, "FILE.part of -o and --stats are both");
    refused({}, "is no field");
    EXPECT_EQ(readText(part), primitives);
    EXPECT_EQ(folder.entries(), 1u);
    std::filesystem::remove(part);
    std::filesystem::create_directory(part);
    refused({}, "is a folder");
    expectBaked("/dev/stdout", {"--frames", "1"});
}

// Placing the probes is no update of theirs.
TEST(ToolBake, countsWhatItGoesOnFrom) {
    const TemporaryFolder folder;
    const std::string file = folder.file("a.field"), stats = folder.file("s.json");
    const Words options = joined(kCoarse, {"--frames", "2", "--relocation", "on", "--stats", stats});
    expectBaked(file + ".part", options);
    expectBaked(file, joined(options, {"--resume"}));
    const auto json = nlohmann::json::parse(readText(stats));
    EXPECT_EQ(json.at("updatesBefore"), 2);
    EXPECT_EQ(json.at("updates"), 0);
    EXPECT_FALSE(json.at("masks").contains("seconds")) << "they were baked before";
    EXPECT_EQ(draw(folder, {"--field", file, "--stats", stats}).size(), 32u * 18);
    EXPECT_FALSE(nlohmann::json::parse(readText(stats)).at("masks").contains("seconds"));
}

TEST(ToolBake, primitivesOfAnotherContentAreAnotherBake) {
    const TemporaryFolder folder;
    const std::string file = folder.file("a.field"), primitives = folder.file("p.sdf.json");
    const Words options{"--frames", "1", "--leak-guard", "moments", "--sdf", primitives};
    const auto write = [&](const std::string& height) {
        writeText(primitives, R"({"sdf": 1, "primitives": [{"shape": "plane", "centre": [0, )" + height + ", 0]}]}");
    };
    write("0");
    expectBaked(file + ".part", options);
    write("0.1");
    expectRefused(joined(joined({"bake", "builtin:dark-room", "-o", file, "--resume"}, kFew), options),
                  "is of another bake", 1);
    write("0");
    expectBaked(file, joined(options, {"--resume"}));
}

TEST(ToolBake, resumesOnlyItsOwn) {
    const TemporaryFolder folder;
    const std::string file = folder.file("room.field"), part = file + ".part";
    const auto refused = [&](const Words& more, const std::string& mentions) {
        expectRefused(joined(joined({"bake", "builtin:dark-room", "-o", file, "--resume"}, kFew), more), mentions, 1);
    };
    refused({"--frames", "2"}, "there is no such file");
    // What is finished is as good a beginning as any.
    expectBaked(part, {"--frames", "2"});
    refused({"--frames", "3"}, "is of another bake");
    refused({"--frames", "2", "--clusters", "3"}, "is of another bake");
    refused({"--frames", "2", "--wall", "0.2"}, "is of another bake");
    refused({"--frames", "2", "--relocation", "on"}, "is of another bake");
    refused({"--frames", "2", "--outside", "0.1,0.2,0.3"}, "is of another bake");
    expectBaked(file, {"--frames", "2", "--resume"});
    EXPECT_FALSE(std::filesystem::exists(part));
    writeText(part, readText(file).substr(0, 1000));
    refused({"--frames", "2"}, "is cut off");
    const ToolRun anew = bake(file, {"--frames", "2"});
    EXPECT_EQ(anew.exitCode, 0);
    EXPECT_THAT(anew.err, HasSubstr("--resume would go on from it"));
}

TEST(ToolBake, warnsOfOtherScenes) {
    const TemporaryFolder folder;
    const std::string file = folder.file("room.field"), picture = folder.file("p.exr");
    expectBaked(file, {"--frames", "2"});
    const auto warning = [&](const std::string& scene, const Words& more) {
        const ToolRun run = runTool(joined({"render", scene, "-o", picture, "--size", "16x9", "--field", file}, more));
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return run.err;
    };
    EXPECT_EQ(warning("builtin:dark-room", {}), "");
    EXPECT_THAT(warning("builtin:two-rooms", {}), HasSubstr("baked for another scene"));
    EXPECT_THAT(warning("builtin:dark-room", {"--wall", "0.05"}), HasSubstr("baked for another scene"));
    EXPECT_THAT(warning("builtin:dark-room", {"--sun", "0,-1,0.1,5"}), HasSubstr("other lights or materials"));
    EXPECT_EQ(warning("builtin:dark-room", {"--sun", "0,-1,0.1,5", "--frames", "1"}), "");
}

TEST(ToolBake, refusesWhatItCannotDo) {
    const TemporaryFolder folder;
    const std::string file = folder.file("room.field"), picture = folder.file("p.exr");
    expectBaked(file, {"--frames", "1"});
    const Words render{"render", "builtin:dark-room", "-o", picture, "--field", file};
    expectRefused(joined(render, {"--probes", "4x4x4"}), "--probes", 2);
    expectRefused(joined(render, {"--rays", "64"}), "--rays", 2);
    for (const char* guard : {"masks", "moments"})
        expectRefused(joined(render, {"--leak-guard", guard}), "the file of --field says", 2);
    expectRefused({"bake", "builtin:dark-room", "-o", file, "--leak-guard", "sdf-shadow"}, "--leak-guard", 2);
    expectRefused(joined(render, {"--method", "none"}), "--field", 2);
    expectRefused({"render", "builtin:dark-room", "-o", file, "--field", file}, "must end in", 1);
    expectRefused({"render", "builtin:dark-room", "-o", picture, "--field", folder.file("no.field")}, "no such file",
                  1);
    const std::string cut = folder.file("cut.field");
    writeText(cut, readText(file).substr(0, 5000));
    expectRefused({"render", "builtin:dark-room", "-o", picture, "--field", cut}, "is cut off or damaged", 1);
    expectRefused({"info", cut}, "is cut off or damaged", 1);
    expectRefused({"compare", cut, file}, "is cut off or damaged", 1);
    std::string damaged = readText(file);
    damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 1);
    writeText(cut, damaged);
    expectRefused({"info", cut}, "does not have its checksum", 1);
    ASSERT_TRUE(writeImage(folder.file("p.png"), HdrImage(4, 4)));
    expectRefused({"render", "builtin:dark-room", "-o", picture, "--field", folder.file("p.png")},
                  "is not a field of ProbeGI", 1);
    expectRefused({"bake", "builtin:dark-room", "-o", folder.file("no/a.field")}, "does not exist", 1);
    expectRefused({"bake", "builtin:dark-room", "-o", file, "--cascades", "2"}, "--leak-guard moments", 2);
    expectRefused({"bake", "builtin:dark-room", "-o", file, "--clusters", "9"}, "--clusters", 2);
    expectRefused({"bake", "builtin:dark-room", "-o", file, "--factor", "1"}, "--factor", 2);
    expectRefused({"bake", "builtin:dark-room", "-o", file, "--leak-guard", "moments", "--strict"}, "--mask-strict", 2);
    expectRefused({"bake", "builtin:dark-room"}, "-o", 2);
}

TEST(ToolBake, cascadesKeepTheirLight) {
    const TemporaryFolder folder;
    const std::string file = folder.file("cascades.field");
    const Words cascades{"--cascades", "2", "--cascade-probes", "6x5x6", "--rays", "32", "--frames", "2"};
    const ToolRun run = runTool(
        joined({"bake", "builtin:dark-room", "-o", file, "--camera", "dark", "--leak-guard", "moments"}, cascades));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(draw(folder, {"--field", file}), draw(folder, cascades));
}

}  // namespace
}  // namespace probegi::test
