#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

// Only checks that the figures are there: timings never decide a test.
TEST(Bench, MeasuresASmallScene) {
    const TemporaryFolder folder;
    const std::string json = folder.file("bench.json");
    const ToolRun run = runTool({"bench", "builtin:cornell", "--probes", "4x4x4", "--rays", "16", "--size", "32x18",
                                 "--rounds", "2", "--threads", "2", "--no-growth", "--json", json});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("| update: all"));
    const auto figures = nlohmann::json::parse(readText(json));
    EXPECT_EQ(figures["probes"], 64);
    EXPECT_EQ(figures["raysPerProbe"], 16);
    EXPECT_EQ(figures["rounds"], 2);
    EXPECT_TRUE(figures["growth"].empty());
    for (const char* row : {"trace", "blend", "update", "query", "picture", "memory", "scaling"})
        EXPECT_GT(figures["rows"][row]["ratio"], 0) << row;
    for (const char* row : {"trace", "blend", "update", "query", "picture", "memory"})
        EXPECT_TRUE(figures["rows"][row]["pass"].is_boolean()) << row;
}

TEST(Bench, RefusesFilesThatItCannotWrite) {
    const ToolRun run = runTool({"bench", "builtin:cornell", "--json", "no/such/folder/bench.json"});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("no/such/folder"));
    EXPECT_TRUE(run.out.empty());
}

}  // namespace
}  // namespace probegi::test
