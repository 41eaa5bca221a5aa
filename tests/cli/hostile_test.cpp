// The program on scenes and pictures that are deliberately wrong, large or far away.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/squares.h"
#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

/// A floor of 2 x 2 m centred at (x, 0, 0), and a camera with a given name above it.
std::string floorAt(double x, const std::string& cameraName = "eye") {
    nlohmann::json scene =
        sceneOfSquares({{{"translation", {x, 0, 0}}, {"children", {1, 2}}},
                        {{"mesh", 0}, {"translation", {-1, 0, -1}}, {"scale", {2, 1, 2}}},
                        {{"camera", 0}, {"translation", {0, 3, 0}}, {"rotation", {-0.7071068, 0, 0, 0.7071068}}}});
    scene["cameras"] = {
        {{"type", "perspective"}, {"name", cameraName}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    return scene.dump();
}

class Hostile : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& text) const {
        writeText(m_folder.file(name), text);
        return m_folder.file(name);
    }
    HdrImage picture(const std::string& scene, std::vector<std::string> more) const {
        const std::string out = m_folder.file("a.exr");
        more.insert(more.begin(), {"render", scene, "-o", out, "--size", "24x24", "--frames", "2", "--rays", "32"});
        const ToolRun run = runTool(more);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return readImage(out).value_or(HdrImage());
    }

    TemporaryFolder m_folder;
};

// At half a million metres, light of lamps and sky was once lost.
TEST_F(Hostile, FarAwayTheLightIsTheSame) {
    const auto draw = [&](const std::string& x) {
        return picture(write("floor.gltf", floorAt(std::stod(x))),
                       {"--point", x + ",1,0,3,2,1", "--sky", "0.5,0.6,0.7", "--look-from", x + ",2,1", "--look-at",
                        x + ",0,0", "--volume", x + ",-0.5,-2:0.5:4x4x8"})
            .pixels;
    };
    const auto near = draw("0"), far = draw("524288");
    ASSERT_EQ(near.size(), 576u);
    EXPECT_GT(near[300].x, 0.1f);
    EXPECT_TRUE(near == far);
    const auto info = nlohmann::json::parse(runTool({"info", m_folder.file("floor.gltf"), "--json"}).out);
    EXPECT_EQ(info["bounds"]["lower"][0], 524287);
    EXPECT_EQ(info["cameras"][0]["position"][0], 524288);
}

TEST_F(Hostile, NamesDoNotReachTheTerminal) {
    const std::string scene = write("a.gltf", floorAt(0, "\x1b]0;title\x07\xe2\x80\xae" + std::string(1 << 20, 'x')));
    const ToolRun text = runTool({"info", scene});
    EXPECT_EQ(text.exitCode, 0);
    EXPECT_LT(text.out.size(), 2000u);
    EXPECT_THAT(text.out, HasSubstr("?]0;title??xxx"));
    EXPECT_EQ(text.out.find('\x1b'), std::string::npos);
    const ToolRun error =
        runTool({"render", scene, "-o", m_folder.file("a.png"), "--sky", "1,1,1", "--camera", "none"});
    EXPECT_EQ(error.exitCode, 1);
    EXPECT_LT(error.err.size(), 2000u);
    EXPECT_THAT(error.err, HasSubstr("--camera 'none' is not in the scene"));
    EXPECT_EQ(error.err.find('\x1b'), std::string::npos);
    expectRefused({"info", m_folder.file("\x1b[2J\xff\n.glb")}, "?[2J? .glb", 1);
}

TEST_F(Hostile, NamesOfPeopleStayAsTheyAre) {
    const std::string scene = write("a.gltf", floorAt(0, "Küche 台所 🏠"));
    EXPECT_THAT(runTool({"info", scene}).out, HasSubstr("'Küche 台所 🏠'"));
}

TEST_F(Hostile, SkiesTooBrightToComputeWith) {
    const std::string sky = m_folder.file("sky.exr");
    ASSERT_TRUE(writeImage(sky, HdrImage(4, 4, glm::vec3(3e38f))));
    expectRefused({"render", "builtin:cornell", "-o", m_folder.file("a.png"), "--sky", sky}, "the limit is 1e+20", 1);
    ASSERT_TRUE(writeImage(sky, HdrImage(4, 4, glm::vec3(1e20f))));
    for (const char* method : {"ddgi", "none"}) {
        const HdrImage image = picture("builtin:cornell", {"--sky", sky, "--method", method, "--probes", "4x4x4"});
        for (const glm::vec3& pixel : image.pixels) {
            ASSERT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z)) << method;
        }
    }
}

TEST_F(Hostile, TheLimitNamesItsOption) {
    std::string nodes = R"({"asset":{"version":"2.0"},"nodes":[{})";
    for (int i = 0; i < 300'000; ++i) nodes += ",{}";
    const std::string scene = write("nodes.gltf", nodes + "]}");
    expectRefused({"info", scene}, "raise --unpack-limit (now 1024)", 1);
    EXPECT_EQ(runTool({"info", scene, "--unpack-limit", "4096"}).exitCode, 0);
    const std::string a = m_folder.file("a.png");
    ASSERT_TRUE(writeImage(a, HdrImage(1024, 1024)));
    expectRefused({"compare", a, a, "--unpack-limit", "8"}, "raise --unpack-limit (now 8)", 1);
    EXPECT_EQ(runTool({"compare", a, a}).exitCode, 0);
}

TEST_F(Hostile, AMicroscopicSceneIsReportedAsSuch) {
    std::string scene = floorAt(0);
    const std::string size = R"("scale":[2,1,2],"translation":[-1,0,-1])";
    ASSERT_NE(scene.find(size), std::string::npos);
    scene.replace(scene.find(size), size.size(), R"("scale":[4e-6,1,4e-6])");
    expectRefused({"render", write("a.gltf", scene), "-o", m_folder.file("a.png"), "--sky", "1,1,1"},
                  "the scene is only 4e-06 m large", 1);
}

TEST_F(Hostile, AFaultOfTheSettingsIsNotTheScenes) {
    const std::string scene = write("a.gltf", floorAt(0));
    write("a.ini", "scene.cameras.0.fov=200\n");
    const ToolRun run = runTool({"info", scene});
    EXPECT_THAT(run.err, HasSubstr("a.ini: "));
    EXPECT_EQ(run.err.find("a.gltf"), std::string::npos);
}

}  // namespace
}  // namespace probegi::test
