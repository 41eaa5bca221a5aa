#include <gmock/gmock.h>
#include <algorithm>

#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A small audit of the dark room; options may replace its method.
std::vector<std::string> audit(std::vector<std::string> more) {
    more.insert(more.begin(), {"audit", "builtin:dark-room", "--wall", "0.1", "--probes", "8x5x8", "--rays", "32",
                               "--frames", "8", "--points", "2000", "--truth-samples", "16"});
    return more;
}

nlohmann::json readJson(const std::string& path) {
    return nlohmann::json::parse(readText(path));
}

TEST(Audit, FindsTheLeakOfAFieldWithoutAGuardAndFails) {
    const TemporaryFolder folder;
    const std::string json = folder.file("leaks.json"), picture = folder.file("leaks.png");
    const ToolRun run = runTool(audit({"--method", "leaky", "--max-leak", "5", "--json", json, "--picture", picture,
                                       "--size", "64x36", "--camera", "dark"}));
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.out, HasSubstr("turn the leak guard on"));
    EXPECT_THAT(run.err, HasSubstr("--max-leak"));
    EXPECT_THAT(run.err, HasSubstr("error: "));
    EXPECT_TRUE(readImage(picture));
    const auto read = readJson(json);
    EXPECT_EQ(read["passed"], false);
    EXPECT_EQ(read["maxLeak"], 0.05);
    EXPECT_EQ(read["scene"], "builtin:dark-room");
    EXPECT_EQ(read["probes"], 8 * 5 * 8);
    EXPECT_EQ(read["points"], 2000);
    EXPECT_GT(read["worst"], 0.05);
    ASSERT_FALSE(read["places"].empty());
    const auto& place = read["places"][0];
    EXPECT_EQ(place["cause"], "guardOff");
    EXPECT_TRUE(place["remedy"]["thicken"].is_null());
    for (const char* key : {"position", "normal", "lower", "upper", "spacing", "probe"})
        EXPECT_EQ(place[key].size(), 3u);
    for (const char* key : {"area", "light", "harm", "points", "probeShare"}) EXPECT_GT(place[key], 0) << key;
    for (const char* key : {"title", "where", "why", "remedy"}) EXPECT_FALSE(place["text"][key].empty()) << key;
    EXPECT_THAT(run.out, HasSubstr(std::string(place["text"]["title"])));
}

TEST(Audit, PassesWhatDoesNotLeak) {
    // Nothing in the furnace is hidden from anything.
    const TemporaryFolder folder;
    const std::string json = folder.file("leaks.json");
    const ToolRun run = runTool({"audit", "builtin:furnace", "--probes", "6x6x6", "--rays", "32", "--frames", "8",
                                 "--points", "500", "--max-leak", "1", "--json", json});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("no leaks found above 1.0 %: 500 points"));
    EXPECT_EQ(readJson(json)["passed"], true);
    EXPECT_TRUE(readJson(json)["places"].empty());
}

TEST(Audit, IsTheSameTwiceAndOnAnyNumberOfThreads) {
    const ToolRun one = runTool(audit({"--threads", "1"})), two = runTool(audit({"--threads", "2"}));
    EXPECT_EQ(one.exitCode, 0) << one.err;
    EXPECT_THAT(one.out, HasSubstr("pairs of a point and a probe"));
    EXPECT_EQ(one.out, two.out);
}

TEST(Audit, MasksLeaveLessToFind) {
    const TemporaryFolder folder;
    const std::string json = folder.file("leaks.json");
    // Points that see no probe go by the distances whatever the masks are: so not the worst place, but all of them.
    const auto leakingArea = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--json", json});
        EXPECT_EQ(runTool(audit(std::move(more))).exitCode, 0);
        return double(readJson(json)["leakingArea"]);
    };
    const double leaky = leakingArea({"--method", "leaky"});
    EXPECT_LT(leakingArea({"--leak-guard", "masks"}), 0.15 * leaky);
    EXPECT_LT(leakingArea({"--leak-guard", "masks", "--mask-strict"}), 0.03 * leaky);
    // One cluster is too few, and the audit says so.
    leakingArea({"--leak-guard", "masks", "--clusters", "1"});
    const auto places = readJson(json)["places"];
    const auto shared =
        std::ranges::find_if(places, [](const auto& place) { return place["cause"] == "sharedCluster"; });
    ASSERT_NE(shared, places.end());
    EXPECT_THAT(std::string((*shared)["text"]["remedy"]), HasSubstr("more clusters"));
    expectRefused(audit({"--leak-guard", "masks", "--method", "leaky"}), "--method ddgi only", 2);
    expectRefused(audit({"--clusters", "3"}), "they act on --leak-guard masks only", 2);
}

TEST(Audit, WritesNothingElseToAStandardOutputThatTakesTheJson) {
    const ToolRun run = runTool(audit({"--json", "/dev/stdout"}));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_TRUE(nlohmann::json::parse(run.out).contains("places"));
}

TEST(Audit, HasExamples) {
    const ToolRun run = runTool({"audit", "--help"});
    EXPECT_EQ(run.exitCode, 0);
    for (const char* word : {"--max-leak", "Example: probegi audit", "exit status"})
        EXPECT_THAT(run.out, HasSubstr(word));
}

class BadAudit : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(BadAudit, IsRefusedWithOneSentenceThatNamesTheOption) {
    const auto& [option, value] = GetParam();
    expectRefused({"audit", "builtin:furnace", option, value}, option, 2);
}

INSTANTIATE_TEST_SUITE_P(Audit, BadAudit,
                         testing::Values(std::pair{"--max-leak", "0"}, std::pair{"--max-leak", "101"},
                                         std::pair{"--max-leak", "nan"}, std::pair{"--max-leak", "much"},
                                         std::pair{"--least", "0"}, std::pair{"--points", "0"},
                                         std::pair{"--points", "1.5"}, std::pair{"--points", "4194305"},
                                         std::pair{"--truth-samples", "-1"}, std::pair{"--method", "reference"},
                                         std::pair{"--size", "0x1"}, std::pair{"--device", "0"},
                                         std::pair{"--leak-guard", "sdf-shadow"}));

TEST(Audit, RefusesFilesItCannotWrite) {
    const TemporaryFolder folder;
    expectRefused({"audit", "builtin:furnace", "--picture", folder.file("a.txt")}, "--picture", 1);
    expectRefused({"audit", "builtin:furnace", "--json", folder.file("none/a.json")}, "none", 1);
    expectRefused({"audit", "builtin:furnace", "--json", folder.file("a.png"), "--picture", folder.file("a.png")},
                  "a.png", 1);
    expectRefused({"audit", folder.file("none.glb")}, "none.glb", 1);
    EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace probegi::test
