// Where the program may write, and what it must not overwrite.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <future>
#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "probegi/image.h"

namespace probegi::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Output : public testing::Test {
protected:
    std::vector<std::string> render(std::vector<std::string> more, const std::string& scene = "builtin:furnace") const {
        more.insert(more.begin(), {"render", scene, "--size", "8x8", "--method", "none"});
        return more;
    }
    std::string link(const std::string& name, const std::string& target) const {
        fs::create_symlink(target, m_folder.file(name));
        return m_folder.file(name);
    }
    void expectGood(const ToolRun& run) const {
        EXPECT_EQ(run.exitCode, 0);
        EXPECT_EQ(run.err, "");
    }

    TemporaryFolder m_folder;
    const std::string m_picture = m_folder.file("a.png");
};

TEST_F(Output, StatsGoIntoAPipe) {
    const std::string pipe = m_folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    auto reader = std::async(std::launch::async, [&] { return readText(pipe); });
    expectGood(runTool(render({"-o", m_picture, "--stats", pipe})));
    EXPECT_TRUE(nlohmann::json::parse(reader.get()).contains("pictureMs"));
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(Output, StatsGoToStandardOutput) {
    const ToolRun run = runTool(render({"-o", m_picture, "--stats", "/dev/stdout"}));
    expectGood(run);
    EXPECT_TRUE(nlohmann::json::parse(run.out).contains("pictureMs"));
}

// Uses links to devices, so that a bug can destroy only the links.
TEST_F(Output, DevicesAndLinksStay) {
    const std::string null = link("null", "/dev/null"), stats = link("stats", "target.json");
    const std::string nullPicture = link("null.png", "/dev/null");
    writeText(m_folder.file("target.json"), "old");
    expectGood(runTool(render({"-o", m_picture, "--stats", null})));
    expectGood(runTool(render({"-o", nullPicture, "--stats", null})));
    expectGood(runTool(render({"-o", m_picture, "--stats", stats})));
    EXPECT_TRUE(fs::is_symlink(null) && fs::is_symlink(stats) && fs::is_symlink(nullPicture));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_TRUE(nlohmann::json::parse(readText(m_folder.file("target.json"))).contains("pictureMs"));
}

TEST_F(Output, AFullDiskIsReportedForEveryOutput) {
    const std::string full = link("full", "/dev/full"), fullPicture = link("full.png", "/dev/full");
    const std::string a = m_folder.file("in.exr");
    ASSERT_TRUE(writeImage(a, HdrImage(8, 8)));
    expectRefused(render({"-o", fullPicture}), "No space left", 1);
    expectRefused(render({"-o", m_picture, "--stats", full}), "No space left", 1);
    expectRefused({"compare", a, a, "--heatmap", fullPicture}, "No space left", 1);
    EXPECT_TRUE(fs::is_symlink(full) && fs::is_symlink(fullPicture));
}

TEST_F(Output, PrintingToAFullDiskIsReportedToo) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"scenes"},
                                                      {"--help"},
                                                      {"render", "--help"},
                                                      {"--version"},
                                                      {},
                                                      {"info", "builtin:cornell"},
                                                      {"info", "builtin:cornell", "--json"}}) {
        const ToolRun run = runTool(arguments, {{}, "/dev/full"});
        EXPECT_EQ(run.exitCode, 1) << testing::PrintToString(arguments);
        EXPECT_THAT(run.err, testing::StartsWith("error: standard output cannot be written (No space left on device)"));
    }
}

TEST_F(Output, FoldersAreRefusedForEveryOutput) {
    fs::create_directory(m_folder.file("folder.png"));
    const std::string folder = m_folder.file("folder.png");
    expectRefused(render({"-o", folder}), "-o " + folder + ": is a folder", 1);
    expectRefused(render({"-o", m_picture, "--stats", folder}), "--stats " + folder + ": is a folder", 1);
    expectRefused({"bench", "builtin:cornell", "--json", folder}, "--json " + folder + ": is a folder", 1);
    expectRefused({"compare", "a.exr", "b.exr", "--heatmap", folder}, "--heatmap " + folder + ": is a folder", 1);
    EXPECT_EQ(m_folder.entries(), 1u);
}

TEST_F(Output, TwoOutputsAreTwoFiles) {
    for (const std::string& stats : {m_picture, m_folder.file("../") + m_folder.path().filename().string() + "/a.png"})
        expectRefused(render({"-o", m_picture, "--stats", stats}), "-o and --stats are both", 1);
    EXPECT_EQ(m_folder.entries(), 0u);
    writeText(m_picture, "old");
    expectRefused(render({"-o", m_picture, "--stats", link("b", "a.png")}), "-o and --stats are both", 1);
    EXPECT_EQ(readText(m_picture), "old");
}

TEST_F(Output, InputsAreNotOverwritten) {
    const std::string scene = m_folder.file("scene.gltf"), settings = m_folder.file("scene.ini");
    const std::string sky = m_folder.file("sky.exr");
    ASSERT_TRUE(writeImage(sky, HdrImage(4, 4, glm::vec3(1))));
    writeText(scene, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    writeText(settings, "# nothing\n");
    const auto text = readText(scene);
    for (const std::string& input : {scene, settings, sky})
        expectRefused(render({"-o", m_picture, "--sky", sky, "--stats", input}, scene), "would overwrite", 1);
    expectRefused(render({"-o", sky, "--sky", sky}, scene), "-o '" + sky + "' would overwrite", 1);
    expectRefused({"bench", scene, "--sky", "1,1,1", "--json", scene}, "would overwrite", 1);
    expectRefused({"compare", sky, sky, "--heatmap", sky}, "would overwrite", 1);
    EXPECT_EQ(readText(scene), text);
    EXPECT_EQ(m_folder.entries(), 3u);
}

TEST_F(Output, AReportOfASceneWithANameThatIsNotText) {
    const std::string scene = m_folder.file(
        "K\xfc"
        "che \x1b[31m.gltf");
    writeText(scene, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    const std::string out = m_folder.file("out");
    const ToolRun run = runTool({"report", scene, "-o", out, "--sky", "1,1,1", "--size", "16x9", "--spp", "1",
                                 "--frames", "1", "--probes", "4x4x4", "--ratio-probes", "1"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("K?che ?[31m.gltf"));
    EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
    const auto numbers = nlohmann::json::parse(readText(out + "/report.json"));
    EXPECT_EQ(numbers.size(), 1u);
    const std::string page = readText(out + "/report.html");
    EXPECT_THAT(page, HasSubstr("K?che ?[31m.gltf"));
    EXPECT_EQ(page.find('\xfc'), std::string::npos);
    EXPECT_EQ(page.find('\x1b'), std::string::npos);
}

TEST_F(Output, ReportsKeepAwayFromTheirScenes) {
    const std::string out = m_folder.file("out");
    fs::create_directory(out);
    const std::string sky = out + "/cornell-sky.exr";
    ASSERT_TRUE(writeImage(sky, HdrImage(4, 4, glm::vec3(1))));
    expectRefused({"report", "builtin:cornell", "-o", out, "--sky", sky}, "could overwrite", 1);
    expectRefused({"report", "builtin:cornell", "-o", out, "--seed", "-1"}, "--seed", 2);
}

}  // namespace
}  // namespace probegi::test
