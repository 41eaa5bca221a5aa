// --leak-guard masks.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

std::vector<std::string> darkRoom(const std::string& picture, std::vector<std::string> more) {
    std::vector<std::string> all{"render",      "builtin:dark-room",
                                 "-o",          picture,
                                 "--camera",    "dark",
                                 "--size",      "32x18",
                                 "--probes",    "9x5x7",
                                 "--rays",      "64",
                                 "--frames",    "20",
                                 "--antialias", "1",
                                 "--aov",       "irradiance"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

double brightness(const std::string& picture) {
    const HdrImage image = readImage(picture).value();
    double sum = 0;
    for (const glm::vec3& pixel : image.pixels) sum += double(pixel.x);
    return sum;
}

TEST(ToolMasks, KeepADarkRoomDark) {
    const TemporaryFolder folder;
    const auto light = [&](std::vector<std::string> more) {
        const std::string picture = folder.file("a.exr");
        EXPECT_EQ(runTool(darkRoom(picture, std::move(more))).exitCode, 0);
        return brightness(picture);
    };
    const double leaky = light({"--method", "leaky"});
    const double masks = light({"--leak-guard", "masks"});
    EXPECT_LT(masks, 0.05 * leaky);
    EXPECT_LT(light({"--leak-guard", "masks", "--mask-strict"}), 0.05 * leaky);
    EXPECT_LT(light({"--leak-guard", "masks", "--relocation", "on"}), 0.05 * leaky);
    EXPECT_EQ(light({"--leak-guard", "moments"}), light({}));
}

TEST(ToolMasks, StatsSayWhatTheyTookAndMade) {
    const TemporaryFolder folder;
    const std::string stats = folder.file("s.json");
    const auto masksOf = [&](std::vector<std::string> more) {
        more.insert(more.end(), {"--leak-guard", "masks", "--stats", stats});
        EXPECT_EQ(runTool(darkRoom(folder.file("a.exr"), std::move(more))).exitCode, 0);
        return nlohmann::json::parse(readText(stats)).at("masks");
    };
    const auto usual = masksOf({});
    EXPECT_EQ(usual.at("cells"), 8 * 4 * 6);
    EXPECT_GT(usual.at("rays"), 1000);
    EXPECT_GT(usual.at("seconds").at("visibility"), 0);
    EXPECT_EQ(usual.at("denseBytes"), 8 * 4 * 6 * 512 * 4);
    const auto eight = masksOf({"--clusters", "8", "--mask-factor", "4"});
    EXPECT_EQ(eight.at("residual"), 0);
    EXPECT_EQ(eight.at("denseBytes"), 8 * 4 * 6 * 64 * 8);
}

TEST(ToolMasks, RefuseWhatTheyCannotDo) {
    const TemporaryFolder folder;
    const std::string out = folder.file("a.png");
    const std::vector<std::string> scene{"render", "builtin:cornell", "-o", out};
    const auto refused = [&](std::vector<std::string> more, const std::string& mentions) {
        more.insert(more.begin(), scene.begin(), scene.end());
        expectRefused(more, mentions, 2);
    };
    refused({"--clusters", "3"}, "--leak-guard masks only");
    refused({"--mask-strict"}, "--leak-guard masks only");
    refused({"--leak-guard", "masks", "--clusters", "9"}, "--clusters");
    refused({"--leak-guard", "masks", "--mask-factor", "1"}, "--mask-factor");
    refused({"--leak-guard", "walls"}, "--leak-guard");
    refused({"--leak-guard", "masks", "--method", "leaky"}, "--method ddgi only");
    refused({"--leak-guard", "masks", "--cascades", "2"}, "without --cascades");
    EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace probegi::test
