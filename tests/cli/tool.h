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

/// Where the program runs.
struct ToolPlace {
    std::filesystem::path folder;  ///< working folder; empty: this program's own
    std::string standardOutput;    ///< where what it prints goes; empty: into ToolRun::out
};

/// Runs the program and waits for it.
ToolRun runTool(const std::vector<std::string>& arguments, const ToolPlace& place = {});

/// Expects a run to be refused: this exit code, nothing on stdout, one sentence on stderr with `mentions` in it.
void expectRefused(const std::vector<std::string>& arguments, const std::string& mentions, int exitCode);

/// A variable of the environment of the programs that are run while the object lives.
class EnvironmentVariable {
public:
    EnvironmentVariable(std::string name, const std::string& value);
    ~EnvironmentVariable();
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

private:
    std::string m_name;
};

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
