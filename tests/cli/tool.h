#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace probegi::test {

/// The result of a run of the program.
struct ToolRun {
    int exitCode = -1;
    std::string out, err;
};

/// Where to run the program.
struct ToolPlace {
    std::filesystem::path folder;  ///< working folder; empty: this program's own
    std::string standardOutput;    ///< file for its output; empty: ToolRun::out
};

/// Runs the program and waits for it.
ToolRun runTool(const std::vector<std::string>& arguments, const ToolPlace& place = {});

/// Expects a run to fail with this exit code, nothing on stdout, and one sentence on stderr that contains `mentions`.
void expectRefused(const std::vector<std::string>& arguments, const std::string& mentions, int exitCode);

/// Sets an environment variable for programs run while the object lives.
class EnvironmentVariable {
public:
    EnvironmentVariable(std::string name, const std::string& value);
    ~EnvironmentVariable();
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

private:
    std::string m_name;
};

/// An empty folder, deleted with the object.
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
