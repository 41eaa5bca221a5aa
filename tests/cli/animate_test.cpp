// `probegi render --animate`: which files it writes, what it refuses, and that things move in its pictures.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Animate : public testing::Test {
protected:
    /// Quick pictures of builtin:moving, or without probes.
    std::vector<std::string> arguments(const std::string& times, const std::string& output,
                                       std::vector<std::string> more = {"--method", "none"},
                                       const std::string& scene = "builtin:moving") const {
        std::vector<std::string> all{"render", scene,   "-o",         output, "--animate",   times,
                                     "--size", "32x18", "--exposure", "1",    "--antialias", "1"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    static std::vector<std::string> withProbes(std::vector<std::string> more = {}) {
        more.insert(more.end(), {"--probes", "4x4x4", "--rays", "32", "--frames", "3", "--updates-per-frame", "2"});
        return more;
    }
    std::string file(const std::string& name) const { return m_folder.file(name); }
    ToolRun good(const std::vector<std::string>& arguments) const {
        const ToolRun run = runTool(arguments);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return run;
    }
    std::vector<glm::vec3> pixels(const std::string& name) const {
        const auto image = readImage(file(name));
        EXPECT_TRUE(image) << name;
        return image ? image->pixels : std::vector<glm::vec3>();
    }
    std::size_t refusedFiles(const std::vector<std::string>& arguments, const std::string& mentions, int exitCode) {
        expectRefused(arguments, mentions, exitCode);
        return m_folder.entries();
    }

    TemporaryFolder m_folder;
};

TEST_F(Animate, WritesAPictureForEachMoment) {
    EXPECT_EQ(good(arguments("0:1:0.25", file("f%03d.png"))).out, "");
    for (const char* name : {"f000.png", "f001.png", "f002.png", "f003.png", "f004.png"})
        EXPECT_TRUE(fs::exists(file(name))) << name;
    EXPECT_EQ(m_folder.entries(), 5u) << "B is a moment too";
}

TEST_F(Animate, DecimalStepsMeetTheEnd) {
    good(arguments("0:0.3:0.1", file("f%d.exr")));
    EXPECT_EQ(m_folder.entries(), 4u);
    good(arguments("1:1:0.1", file("one%d.exr")));
    EXPECT_EQ(m_folder.entries(), 5u) << "one moment";
    good(arguments("0:0.25:0.1", file("100%%-%02d.exr")));
    EXPECT_TRUE(fs::exists(file("100%-02.exr")));
    EXPECT_FALSE(fs::exists(file("100%-03.exr"))) << "0.3 s is after the end";
}

// A picture of an animation without probes is the single picture at its moment.
TEST_F(Animate, PicturesAreThoseOfTheirMoments) {
    good(arguments("0:4:2", file("f%d.exr"), {"--method", "none", "--camera", "tracking"}));
    for (const char* moment : {"0", "2", "4"}) {
        good({"render", "builtin:moving", "-o", file("single.exr"), "--size", "32x18", "--antialias", "1", "--method",
              "none", "--camera", "tracking", "--time-of-scene", moment});
        const auto single = pixels("single.exr"), frame = pixels("f" + std::to_string(std::stoi(moment) / 2) + ".exr");
        ASSERT_EQ(single.size(), frame.size());
        // What can move is not merged with the rest, so positions round differently.
        int differing = 0;
        for (std::size_t i = 0; i < single.size(); ++i)
            differing += std::abs(single[i].x - frame[i].x) > 1e-3f * (single[i].x + 1e-3f) ? 1 : 0;
        EXPECT_LE(differing, 3) << moment;
    }
}

// Objects, lights and cameras move: each alone changes the picture.
TEST_F(Animate, EverythingMoves) {
    // The lamp moves from 0 s on, the box not before 1 s, only the tracking camera moves.
    const std::vector<std::string> direct{"--method", "none", "--aov", "direct"},
        depth{"--method", "none", "--aov", "depth"};
    good(arguments("0:0.9:0.9", file("light%d.exr"), direct));
    EXPECT_NE(pixels("light0.exr"), pixels("light1.exr"));
    std::vector<std::string> camera = depth;
    camera.insert(camera.end(), {"--camera", "tracking"});
    good(arguments("0:0.9:0.9", file("camera%d.exr"), camera));
    EXPECT_NE(pixels("camera0.exr"), pixels("camera1.exr"));
    std::vector<std::string> below = depth;
    below.insert(below.end(), {"--look-from", "0,0.4,-1.9", "--look-at", "0,0.4,1"});
    good(arguments("0:0.9:0.9", file("still%d.exr"), below));
    EXPECT_EQ(pixels("still0.exr"), pixels("still1.exr")) << "the box stands still, the lamp is out of sight";
    good(arguments("0.9:2:1.1", file("box%d.exr"), below));
    EXPECT_NE(pixels("box0.exr"), pixels("box1.exr"));
}

TEST_F(Animate, TwoRunsAreTheSame) {
    for (const char* threads : {"1", "2"})
        good(arguments("0.5:1.5:0.5", file(std::string(threads) + "-%d.exr"), withProbes({"--threads", threads})));
    for (const char* number : {"0", "1", "2"}) {
        EXPECT_EQ(readText(file(std::string("1-") + number + ".exr")),
                  readText(file(std::string("2-") + number + ".exr")));
    }
}

// The search for an exposure leaves no trace in the probes.
TEST_F(Animate, OneExposureForAllPictures) {
    auto automatic = arguments("1:2:0.25", file("a%d.png"), withProbes());
    const auto at = std::find(automatic.begin(), automatic.end(), "--exposure");
    *(at + 1) = "auto";
    const ToolRun run = good(automatic);
    EXPECT_THAT(run.out, HasSubstr("chosen automatically for all pictures"));
    auto given = arguments("1:2:0.25", file("b%d.exr"), withProbes());
    auto linear = automatic;
    for (std::string& argument : linear)
        if (argument == file("a%d.png")) argument = file("c%d.exr");
    EXPECT_EQ(good(linear).out, "") << "an .exr has no exposure";
    good(given);
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(pixels("b" + std::to_string(i) + ".exr"), pixels("c" + std::to_string(i) + ".exr"));
    // The printed number gives the same .png, though it is rounded: within a step of 8 bits.
    const std::string factor = run.out.substr(run.out.rfind(' ') + 1);
    auto told = automatic;
    for (std::string& argument : told) {
        if (argument == "auto") argument = factor.substr(0, factor.size() - 1);
        if (argument == file("a%d.png")) argument = file("d%d.png");
    }
    good(told);
    for (int i = 0; i < 5; ++i) {
        const auto a = pixels("a" + std::to_string(i) + ".png"), d = pixels("d" + std::to_string(i) + ".png");
        ASSERT_EQ(a.size(), d.size());
        for (std::size_t p = 0; p < a.size(); ++p) ASSERT_NEAR(a[p].y, d[p].y, 0.011) << i;
    }
}

// The field is kept: what a picture shows depends on the ones before, and on events.
TEST_F(Animate, ProbesAreKeptFromPictureToPicture) {
    // Enough updates that windows are longer than an event leaves them.
    const auto settled = [](std::vector<std::string> more) {
        more.insert(more.end(), {"--probes", "4x4x4", "--rays", "32", "--frames", "40", "--updates-per-frame", "1"});
        return more;
    };
    good(arguments("0:4:2", file("kept%d.exr"), settled({})));
    good(arguments("4:4:1", file("fresh%d.exr"), settled({})));
    EXPECT_NE(pixels("kept2.exr"), pixels("fresh0.exr"));
    // A door that opens at once: its distances are what events speed up most.
    good(arguments("1:3:2", file("told%d.exr"), settled({"--camera", "second"}), "builtin:door"));
    good(arguments("1:3:2", file("untold%d.exr"), settled({"--camera", "second", "--events", "off"}), "builtin:door"));
    EXPECT_EQ(pixels("told0.exr"), pixels("untold0.exr"));
    EXPECT_NE(pixels("told1.exr"), pixels("untold1.exr"));
}

TEST_F(Animate, StatsHaveTimesOfEachPicture) {
    good(arguments("0:4:2", file("f%d.png"), withProbes({"--stats", file("s.json")})));
    const auto json = nlohmann::json::parse(readText(file("s.json")));
    EXPECT_EQ(json["probes"], 64);
    EXPECT_EQ(json["fillUpdates"], 3);
    EXPECT_EQ(json["updatesPerFrame"], 2);
    EXPECT_EQ(json["exposure"], 1.0);
    ASSERT_EQ(json["frames"].size(), 3u);
    EXPECT_EQ(json["frames"][1]["file"], file("f1.png"));
    EXPECT_EQ(json["frames"][1]["seconds"], 2.0);
    for (const char* key : {"poseMs", "editsMs", "updateMs", "pictureMs", "writeMs"})
        EXPECT_GT(json["frames"][1][key], 0) << key;
    EXPECT_GE(json["frames"][1]["edits"], 1);
}

TEST_F(Animate, MasksFollowWhatMoves) {
    good(arguments(
        "1:3:1", file("m%d.exr"),
        withProbes({"--leak-guard", "masks", "--mask-factor", "3", "--camera", "second", "--stats", file("s.json")}),
        "builtin:door"));
    const auto frames = nlohmann::json::parse(readText(file("s.json")))["frames"];
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames[0]["maskCells"], 0);
    EXPECT_GT(frames[1]["maskCells"], 0) << "the door has opened";
    EXPECT_EQ(frames[1]["masksSettled"], true);
    // With the masks of the open door the same moment is lit alike, however it came about.
    const auto draw = [&](const char* times, const char* pattern) {
        good(arguments(times, file(pattern),
                       {"--leak-guard", "masks", "--mask-factor", "3", "--camera", "second", "--probes", "8x4x5",
                        "--rays", "32", "--frames", "80", "--updates-per-frame", "240"},
                       "builtin:door"));
    };
    draw("3:3:1", "open%d.exr");
    draw("1:3:2", "kept%d.exr");
    const auto light = [&](const char* name) {
        double sum = 0;
        for (const glm::vec3& pixel : pixels(name)) sum += double(pixel.x + pixel.y + pixel.z);
        return sum;
    };
    EXPECT_GT(light("kept1.exr"), 1.02 * light("kept0.exr")) << "light comes through the door";
    EXPECT_NEAR(light("kept1.exr"), light("open0.exr"), 0.1 * light("open0.exr"));
}

TEST_F(Animate, MasksMayTakeSeveralPictures) {
    const std::vector<std::string> more{"--leak-guard", "masks",    "--mask-budget", "0.1",     "--mask-factor",
                                        "12",           "--camera", "second",        "--stats", file("s.json")};
    good(arguments("1:3:1", file("m%d.exr"), withProbes(more), "builtin:door"));
    const auto frames = nlohmann::json::parse(readText(file("s.json")))["frames"];
    EXPECT_EQ(frames[0]["masksSettled"], true);
    EXPECT_EQ(frames[1]["masksSettled"], false) << "not in a tenth of a millisecond";
    expectRefused({"render", "builtin:door", "-o", file("x.png"), "--leak-guard", "masks", "--mask-budget", "5"},
                  "give --animate", 2);
}

TEST_F(Animate, OfTheReference) {
    good(arguments("0:4:4", file("f%d.exr"), {"--method", "reference", "--spp", "2"}));
    EXPECT_EQ(m_folder.entries(), 2u);
    EXPECT_NE(pixels("f0.exr"), pixels("f1.exr"));
}

TEST_F(Animate, WhereNothingMovesItSaysSo) {
    const ToolRun still = runTool(arguments("0:1:1", file("f%d.exr"), {"--method", "none"}, "builtin:cornell"));
    EXPECT_EQ(still.exitCode, 0);
    EXPECT_THAT(still.err, HasSubstr("nothing in the scene is animated"));
    const ToolRun late = runTool(arguments("5:6:1", file("l%d.exr")));
    EXPECT_EQ(late.exitCode, 0);
    EXPECT_THAT(late.err, HasSubstr("from second 0 to 4: nothing moves"));
    EXPECT_EQ(m_folder.entries(), 4u);
}

TEST_F(Animate, RefusesBadTimes) {
    const std::string output = file("f%d.png");
    for (const auto& [times, mentions] :
         {std::pair("0:1", "A:B:STEP"), std::pair("0:1:0.1:2", "A:B:STEP"), std::pair("a:1:1", "A:B:STEP"),
          std::pair("0:1:", "A:B:STEP"), std::pair("0:nan:1", "A:B:STEP"), std::pair("0:1e9:1", "A:B:STEP"),
          std::pair("2:1:0.5", "ends before it begins"), std::pair("0:1:0", "above 0"), std::pair("0:1:-1", "above 0"),
          std::pair("0:1000:0.001", "the limit is 100000")})
        EXPECT_EQ(refusedFiles(arguments(times, output), mentions, 2), 0u) << times;
    EXPECT_EQ(refusedFiles(arguments("0:1:1", output, {"--time-of-scene", "1"}), "--time-of-scene", 2), 0u);
    EXPECT_EQ(refusedFiles(arguments("0:1:1", output, {"--updates-per-frame", "0"}), "--updates-per-frame", 2), 0u);
    EXPECT_EQ(refusedFiles(arguments("0:1:1", output, {"--events", "maybe"}), "--events", 2), 0u);
}

TEST_F(Animate, RefusesBadPatterns) {
    for (const auto& [name, mentions] :
         {std::pair("f.png", "has no number"), std::pair("f%%.png", "has no number"),
          std::pair("f%d-%d.png", "more than one number"), std::pair("f%s.png", "neither %d"),
          std::pair("f%4d.png", "neither %d"), std::pair("f%.png", "neither %d"),
          std::pair("f%0999d.png", "neither %d"), std::pair("%d/f.png", "in the name of a folder"),
          std::pair("f%d.jpg", "must end in .png or .exr"), std::pair("none/f%d.png", "does not exist")})
        EXPECT_EQ(refusedFiles(arguments("0:1:1", file(name)), mentions, 1), 0u) << name;
    EXPECT_EQ(refusedFiles({"render", "builtin:cornell", "-o", file("a.mp4")}, "is a video", 1), 0u);
}

TEST_F(Animate, OverwritesNothingElse) {
    expectRefused(arguments("0:2:1", file("f%d.png"), {"--method", "none", "--stats", file("f2.png")}),
                  "is also one of the pictures", 1);
    fs::create_directory(file("f1.png"));
    const ToolRun run = runTool(arguments("0:2:1", file("f%d.png")));
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("is a folder"));
}

/// Puts a program called ffmpeg first on the path; without a script the path has no program at all.
class AnimateVideo : public Animate {
protected:
    AnimateVideo() : m_oldPath(std::getenv("PATH") ? std::getenv("PATH") : "") {}
    ~AnimateVideo() override { setenv("PATH", m_oldPath.c_str(), 1); }

    void usePath(const std::string& script) {
        if (script.empty()) {
            setenv("PATH", m_programs.path().c_str(), 1);
            return;
        }
        writeText(m_programs.file("ffmpeg"), "#!/bin/sh\n" + script);
        ::chmod(m_programs.file("ffmpeg").c_str(), 0700);
        setenv("PATH", (m_programs.path().string() + ":" + m_oldPath).c_str(), 1);
    }

    TemporaryFolder m_programs;
    std::string m_oldPath;
};

// The stand-in copies what it gets to what it is told to write, and keeps its arguments.
TEST_F(AnimateVideo, FfmpegGetsAllPictures) {
    usePath("for last; do :; done\necho \"$@\" > " + m_programs.file("arguments") + "\ncat > \"$last\"\n");
    good(arguments("0:1:0.25", file("a.mp4")));
    EXPECT_EQ(m_folder.entries(), 1u);
    EXPECT_EQ(fs::file_size(file("a.mp4")), 5u * 32 * 18 * 3);
    const std::string said = readText(m_programs.file("arguments"));
    for (const char* part : {"-video_size 32x18", "-framerate 4.000000", "-pix_fmt rgb24", "-f mp4", "libx264"})
        EXPECT_THAT(said, HasSubstr(part));
    good(arguments("0:1:0.25", file("a.webm")));
    EXPECT_THAT(readText(m_programs.file("arguments")), HasSubstr("-f webm"));
    // The first picture's first pixel is what a .png has there.
    good(arguments("0:0:1", file("p%d.png")));
    const auto png = readImage(file("p0.png"));
    ASSERT_TRUE(png);
    const auto byte = std::uint8_t(readText(file("a.mp4"))[0]);
    EXPECT_NEAR(double(byte) / 255, double(toDisplay(png->pixels[0], ToneMap()).x), 1.5 / 255);
}

TEST_F(AnimateVideo, FailuresLeaveNothing) {
    usePath("");
    EXPECT_EQ(refusedFiles(arguments("0:1:1", file("a.mp4")), "ffmpeg program, which is not installed", 1), 0u);
    usePath("echo 'no such codec' >&2\nexit 1\n");
    EXPECT_EQ(refusedFiles(arguments("0:1:0.1", file("a.mp4")), "ffmpeg says: no such codec", 1), 0u);
    usePath("cat > /dev/null\n");
    EXPECT_EQ(refusedFiles(arguments("0:1:1", file("a.mp4")), "empty file", 1), 0u);
    usePath("for last; do :; done\ncat > \"$last\"\nexit 3\n");
    EXPECT_EQ(refusedFiles(arguments("0:1:1", file("a.mp4")), "ffmpeg failed", 1), 0u);
}

}  // namespace
}  // namespace probegi::test
