#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace probegi::test {

/// What a run of the program left.
struct ToolRun {
    int exitCode = -1;
    std::string out, err;
};

/// Runs the program and waits for it.
ToolRun runTool(const std::vector<std::string>& arguments);

/// An empty folder that goes away with its object.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string file(const std::string& name) const { return (m_path / name).string(); }
    const std::filesystem::path& path() const { return m_path; }
    std::size_t entries() const;

private:
    std::filesystem::path m_path;
};

std::string readText(const std::filesystem::path& path);
void writeText(const std::filesystem::path& path, const std::string& text);

}  // namespace probegi::test
