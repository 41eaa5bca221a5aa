#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "cli/tool.h"
#include "support/source_folder.h"

// The README's block of commands, run line by line in one folder. To be fast, options are added at the end of each
// line, and the reference's time is shortened; nothing else is changed.
namespace probegi::test {
namespace {

using Words = std::vector<std::string>;

std::vector<Words> commandsOfReadme() {
    std::ifstream readme(sourceFolder() / "README.md");
    const std::string mark = "    probegi ";
    std::vector<Words> commands;
    for (std::string line; std::getline(readme, line);) {
        if (line.compare(0, mark.size(), mark) != 0) continue;
        std::istringstream words(line.substr(mark.size(), line.find('#') - mark.size()));
        commands.push_back({std::istream_iterator<std::string>(words), {}});
    }
    return commands;
}

Words quick(Words words) {
    const auto time = std::find(words.begin(), words.end(), "--time");
    const bool reference = time != words.end();
    const bool baked = std::find(words.begin(), words.end(), "--field") != words.end();
    if (reference) *std::next(time) = "0.2";
    const std::map<std::string, Words> more{
        {"bake", {"--probes", "4x4x4", "--rays", "32", "--frames", "2", "--factor", "4"}},
        {"render", reference || baked ? Words{"--size", "32x18"}
                                      : Words{"--size", "32x18", "--probes", "4x4x4", "--rays", "32", "--frames", "2"}},
        {"audit",
         {"--size", "32x18", "--probes", "4x4x4", "--rays", "32", "--frames", "2", "--points", "256", "--truth-samples",
          "4"}},
        {"report",
         {"--size", "32x18", "--spp", "1", "--probes", "4x4x4", "--rays", "32", "--frames", "2", "--ratio-probes",
          "4"}},
        {"bench",
         {"--size", "32x18", "--probes", "4x4x4", "--rays", "16", "--rounds", "1", "--threads", "2", "--no-growth"}}};
    if (const auto entry = more.find(words.front()); entry != more.end())
        words.insert(words.end(), entry->second.begin(), entry->second.end());
    return words;
}

bool isResult(const std::string& option) {
    return option == "-o" || option == "--heatmap" || option == "--picture";
}

// The file, or the first of --animate: "a%02d.png" is "a00.png" then.
std::string firstFile(std::string name) {
    const std::size_t begin = name.find('%');
    if (begin == std::string::npos) return name;
    const std::size_t end = name.find('d', begin), digits = std::size_t(std::stoi(name.substr(begin + 1)));
    return name.replace(begin, end + 1 - begin, std::string(digits, '0'));
}

TEST(Readme, EveryLineOfItsToolBlockWorks) {
    const TemporaryFolder folder;
    const std::vector<Words> commands = commandsOfReadme();
    std::map<std::string, int> seen;
    for (const Words& words : commands) {
        SCOPED_TRACE(testing::PrintToString(words));
        ++seen[words.front()];
#if !PROBEGI_HAS_VULKAN
        if (words.front() == "devices") continue;
#endif
        const ToolRun run = runTool(quick(words), {folder.path(), {}});
        EXPECT_EQ(run.exitCode, 0) << run.err;
        for (std::size_t i = 0; i + 1 < words.size(); ++i)
            if (isResult(words[i])) {
                EXPECT_TRUE(std::filesystem::exists(folder.file(firstFile(words[i + 1]))));
            }
    }
    for (const char* command : {"scenes", "info", "render", "compare", "bake", "audit", "report", "bench", "devices"})
        EXPECT_GE(seen[command], 1) << command << " is not in the README";
}

}  // namespace
}  // namespace probegi::test
