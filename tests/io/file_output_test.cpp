// writeFile() onto existing files, links, pipes and devices.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>

#include "probegi/io.h"

namespace probegi::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::span<const std::uint8_t> bytesOf(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class FileOutput : public testing::Test {
protected:
    FileOutput() : m_folder(fs::temp_directory_path() / ("probegi_output_" + std::to_string(getpid()))) {
        fs::create_directories(m_folder);
    }
    ~FileOutput() override { fs::remove_all(m_folder); }

    fs::path path(const char* name) const { return m_folder / name; }
    std::size_t fileCount() const {
        return std::size_t(std::distance(fs::directory_iterator(m_folder), fs::directory_iterator()));
    }
    /// Expects the check and the writing to succeed.
    void expectWritten(const fs::path& to, const std::string& text) const {
        const auto checked = checkWritable(to);
        EXPECT_TRUE(checked) << checked.error().message;
        const auto written = writeFile(to, bytesOf(text));
        EXPECT_TRUE(written) << written.error().message;
    }
    void expectRefused(const Result<void>& result, const fs::path& to, const char* words) const {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::writeFailed);
        EXPECT_THAT(result.error().message, HasSubstr(to.string()));
        EXPECT_THAT(result.error().message, HasSubstr(words));
    }

    fs::path m_folder;
};

TEST_F(FileOutput, MakesAndReplacesFiles) {
    expectWritten(path("a"), "one");
    EXPECT_EQ(read(path("a")), "one");
    expectWritten(path("a"), "");
    EXPECT_EQ(read(path("a")), "");
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(FileOutput, CheckingLeavesNoTrace) {
    EXPECT_TRUE(checkWritable(path("a")));
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(FileOutput, WhoMayReadTheOldMayReadTheNew) {
    expectWritten(path("a"), "one");
    ASSERT_EQ(chmod(path("a").c_str(), 0600), 0);
    expectWritten(path("a"), "two");
    struct stat status {};
    ASSERT_EQ(stat(path("a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST_F(FileOutput, LinksStayLinks) {
    expectWritten(path("target"), "old");
    fs::create_symlink("target", path("link"));
    fs::create_symlink(path("link"), path("second"));
    fs::create_symlink("new", path("dangling"));
    expectWritten(path("second"), "text");
    expectWritten(path("dangling"), "made");
    for (const char* link : {"link", "second", "dangling"}) EXPECT_TRUE(fs::is_symlink(path(link))) << link;
    EXPECT_EQ(read(path("target")), "text");
    EXPECT_FALSE(fs::is_symlink(path("target")));
    EXPECT_EQ(read(path("new")), "made");
    fs::create_symlink("loop", path("loop"));
    expectRefused(checkWritable(path("loop")), path("loop"), "cannot be written");
    expectRefused(writeFile(path("loop"), bytesOf("x")), path("loop"), "cannot be written");
}

TEST_F(FileOutput, PipesAreWrittenInto) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    auto reader = std::async(std::launch::async, [&] { return read(path("pipe")); });
    const std::string text(200'000, 'x');  // more than a pipe holds
    expectWritten(path("pipe"), text);
    EXPECT_EQ(reader.get(), text);
    EXPECT_TRUE(fs::is_fifo(path("pipe")));
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(FileOutput, DevicesAreWrittenInto) {
    // Through links, so that a bug can destroy only the links.
    fs::create_symlink("/dev/null", path("null"));
    fs::create_symlink("/dev/full", path("full"));
    expectWritten(path("null"), "gone");
    EXPECT_TRUE(checkWritable(path("full")));
    expectRefused(writeFile(path("full"), bytesOf("x")), path("full"), "No space left");
    for (const char* link : {"null", "full"}) EXPECT_TRUE(fs::is_symlink(path(link))) << link;
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(FileOutput, StreamsOfThisProcessGoOn) {
    const int descriptor = open(path("log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    ASSERT_GE(descriptor, 0);
    ASSERT_EQ(write(descriptor, "before ", 7), 7);
    expectWritten("/dev/fd/" + std::to_string(descriptor), "text");
    ASSERT_EQ(write(descriptor, " after", 6), 6);
    close(descriptor);
    EXPECT_EQ(read(path("log")), "before text after");
    const int readOnly = open(path("log").c_str(), O_RDONLY);
    EXPECT_FALSE(checkWritable("/dev/fd/" + std::to_string(readOnly)));
    close(readOnly);
}

TEST_F(FileOutput, FoldersAreRefused) {
    fs::create_directory(path("folder"));
    fs::create_symlink("folder", path("link"));
    for (const char* name : {"folder", "link"}) {
        expectRefused(checkWritable(path(name)), path(name), "is a folder");
        expectRefused(writeFile(path(name), bytesOf("x")), path(name), "is a folder");
    }
    expectRefused(checkWritable(path("none") / "a"), path("none") / "a", "does not exist");
    expectWritten(path("file"), "x");
    expectRefused(writeFile(path("file") / "a", bytesOf("x")), path("file") / "a", "cannot be written");
}

TEST_F(FileOutput, PlacesThatTakeNoFilesAreFoundBeforeTheWork) {
    // Places where even root cannot create files, though the folder is writable.
    for (const char* place : {"/proc/a.png", "/dev/fd/777"})
        expectRefused(checkWritable(place), place, "cannot be written");
}

// A process that dies in the middle of writing, as by Ctrl-C: here by a limit on file sizes, which is reproducible.
TEST_F(FileOutput, AnEndInTheMiddleLeavesNothing) {
    expectWritten(path("a"), "old");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const rlimit small{1000, 1000};
        setrlimit(RLIMIT_FSIZE, &small);
        const std::string large(1 << 20, 'x');
        (void)writeFile(path("a"), bytesOf(large));
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it was not interrupted";
    EXPECT_EQ(read(path("a")), "old");
    EXPECT_EQ(fileCount(), 1u);
}

}  // namespace
}  // namespace probegi::test
