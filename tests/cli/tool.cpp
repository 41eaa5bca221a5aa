#include "cli/tool.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace probegi::test {

namespace fs = std::filesystem;

ToolRun runTool(const std::vector<std::string>& arguments, const ToolPlace& place) {
    const TemporaryFolder texts;
    const std::string out = place.standardOutput.empty() ? texts.file("out") : place.standardOutput;
    const std::string err = texts.file("err");
    std::string program = PROBEGI_TOOL;
    std::vector<std::string> copies = arguments;
    std::vector<char*> argv{program.data()};
    for (std::string& argument : copies) argv.push_back(argument.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
    if (!place.folder.empty()) posix_spawn_file_actions_addchdir_np(&files, place.folder.c_str());
    pid_t child = 0;
    const int failed = posix_spawn(&child, program.c_str(), &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failed) throw std::runtime_error("cannot start " + program);
    int status = 0;
    if (waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait for " + program);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, place.standardOutput.empty() ? readText(out) : std::string(),
            readText(err)};
}

void expectRefused(const std::vector<std::string>& arguments, const std::string& mentions, int exitCode) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const ToolRun run = runTool(arguments);
    EXPECT_EQ(run.exitCode, exitCode);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, testing::StartsWith("error: "));
    EXPECT_THAT(run.err, testing::HasSubstr(mentions));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

EnvironmentVariable::EnvironmentVariable(std::string name, const std::string& value) : m_name(std::move(name)) {
    setenv(m_name.c_str(), value.c_str(), 1);
}

EnvironmentVariable::~EnvironmentVariable() {
    unsetenv(m_name.c_str());
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "probegi_cli_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
    m_path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(m_path, ignored);
}

std::size_t TemporaryFolder::entries() const {
    return std::size_t(std::distance(fs::directory_iterator(m_path), fs::directory_iterator()));
}

std::string readText(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void writeText(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace probegi::test
