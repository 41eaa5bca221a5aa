#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

/// A small fit of the Cornell box.
std::vector<std::string> fit(std::vector<std::string> more) {
    more.insert(more.begin(), {"fit", "builtin:cornell", "--max-primitives", "10", "--rays", "20000", "--rounds", "2"});
    return more;
}

nlohmann::json readJson(const std::string& path) {
    return nlohmann::json::parse(readText(path));
}

TEST(Fit, WritesPrimitivesAPictureAndNumbers) {
    const TemporaryFolder folder;
    const std::string out = folder.file("cornell.sdf.json"), picture = folder.file("fit.png");
    const std::string stats = folder.file("fit.json");
    const ToolRun run = runTool(fit({"-o", out, "--picture", picture, "--size", "32x32", "--stats", stats}));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("mean distance"));
    EXPECT_THAT(run.out, HasSubstr("leaking"));
    EXPECT_TRUE(readImage(picture));
    const auto primitives = readJson(out)["primitives"];
    EXPECT_GE(primitives.size(), 5u);
    EXPECT_LE(primitives.size(), 10u);
    const auto numbers = readJson(stats);
    EXPECT_EQ(numbers["primitives"], primitives.size());
    EXPECT_EQ(numbers["geometryBytes"], 48 * primitives.size());
    EXPECT_LT(numbers["toPrimitives"], 0.02);
    EXPECT_LT(numbers["leaking"], 0.01);
}

TEST(Fit, KeepsPinnedPrimitivesOfTheFileThatItReplaces) {
    const TemporaryFolder folder;
    const std::string out = folder.file("edited.sdf.json");
    std::ofstream(out) << R"({"sdf": 1, "primitives": [{"name": "mine", "shape": "box", "centre": [0, 9, 0],
        "halfSize": [1, 1, 1], "albedo": [0.1, 0.2, 0.3], "pinned": true}]})";
    const ToolRun run = runTool(fit({"-o", out}));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    const auto primitives = readJson(out)["primitives"];
    EXPECT_EQ(primitives[0]["name"], "mine");
    EXPECT_EQ(primitives[0]["pinned"], true);
    EXPECT_GT(primitives.size(), 5u);
}

TEST(Fit, MeasuresAFileAndLeavesItAlone) {
    const TemporaryFolder folder;
    const std::string file = folder.file("void.sdf.json");
    std::ofstream(file) << R"({"sdf": 1, "primitives": []})";
    const std::string before = readText(file);
    const ToolRun run = runTool({"fit", "builtin:cornell", "--check", file});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("0 primitives"));
    EXPECT_EQ(readText(file), before);
}

TEST(Fit, SaysWhatIsWrong) {
    const TemporaryFolder folder;
    const std::string broken = folder.file("broken.sdf.json");
    std::ofstream(broken) << "{\"sdf\": 1, \"primitives\": [{\"shape\": \"ball\"}]}";
    EXPECT_THAT(runTool(fit({})).err, HasSubstr("give either -o FILE"));
    EXPECT_THAT(runTool(fit({"-o", folder.file("a"), "--check", broken})).err, HasSubstr("give either -o FILE"));
    EXPECT_THAT(runTool(fit({"--check", broken})).err, HasSubstr("broken.sdf.json"));
    // What would be replaced is not JSON of ours: it stays.
    const ToolRun over = runTool(fit({"-o", broken}));
    EXPECT_EQ(over.exitCode, 1);
    EXPECT_THAT(readText(broken), HasSubstr("ball"));
    EXPECT_THAT(runTool(fit({"-o", folder.file("a"), "--max-primitives", "0"})).err, HasSubstr("--max-primitives"));
    EXPECT_THAT(runTool(fit({"-o", folder.file("a"), "--picture", folder.file("p.png"), "--camera", "7"})).err,
                HasSubstr("--camera 7"));
}

}  // namespace
}  // namespace probegi::test
