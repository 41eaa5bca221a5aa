#include "animation/video_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "probegi/io.h"

extern char** environ;  // POSIX: what a program passes on

namespace probegi::tool {

namespace fs = std::filesystem;

namespace {

constexpr int kOutputDescriptor = 3;  // in ffmpeg

bool isInstalled(const char* program) {
    const char* folders = std::getenv("PATH");
    std::string_view rest = folders ? folders : "";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        const std::string file = fmt::format("{}/{}", rest.substr(0, end), program);
        if (::access(file.c_str(), X_OK) == 0 && !fs::is_directory(file)) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

/// A file without a name: whatever happens, nothing of it stays.
using Unnamed = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

Unnamed unnamedFile() {
    return {std::tmpfile(), std::fclose};
}

std::vector<std::uint8_t> bytesOf(std::FILE* file) {
    std::vector<std::uint8_t> bytes;
    struct stat status {};
    if (::fstat(::fileno(file), &status) == 0) bytes.resize(std::size_t(status.st_size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t read = ::pread(::fileno(file), bytes.data() + done, bytes.size() - done, off_t(done));
        if (read <= 0 && errno != EINTR) break;
        done += std::size_t(std::max<ssize_t>(read, 0));
    }
    bytes.resize(done);
    return bytes;
}

std::string lastLine(const std::vector<std::uint8_t>& text) {
    std::string line(text.begin(), text.end());
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
    const std::size_t begin = line.find_last_of('\n');
    return begin == std::string::npos ? line : line.substr(begin + 1);
}

// Sides are even in 4:2:0.
std::vector<std::string> arguments(const fs::path& path, int width, int height, double framesPerSecond) {
    std::vector<std::string> words{"ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error", "-y"};
    const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    add({"-f", "rawvideo", "-pix_fmt", "rgb24", "-video_size", fmt::format("{}x{}", width, height), "-framerate",
         fmt::format("{:.6f}", framesPerSecond), "-i", "pipe:0"});
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p"});
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
    if (path.extension() == ".webm")
        add({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-f", "webm"});
    else
        add({"-c:v", "libx264", "-crf", "18", "-f", "mp4"});
    add({fmt::format("/dev/fd/{}", kOutputDescriptor)});
    return words;
}

/// Starts ffmpeg; errno on failure.
int start(std::vector<std::string> words, int input, int output, int messages, pid_t& child) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, kOutputDescriptor);
    const int error = posix_spawnp(&child, "ffmpeg", &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

Error cannotWrite(const fs::path& path, std::string_view why) {
    return fail(ErrorCode::writeFailed, fmt::format("'{}' cannot be written: {}", path.string(), why));
}

// A descriptor that is not handed on to other programs, and above those that ffmpeg gets.
int kept(int descriptor) {
    const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 16);
    ::close(descriptor);
    return moved;
}

}  // namespace

std::vector<std::string_view> videoExtensions() {
    return {".mp4", ".webm"};
}

bool isVideo(const fs::path& path) {
    return path.extension() == ".mp4" || path.extension() == ".webm";
}

Result<void> checkVideoWriter(const fs::path& path) {
    if (isInstalled("ffmpeg")) return {};
    return fail(ErrorCode::unsupported,
                fmt::format("'{}' is written by the ffmpeg program, which is not installed; install it, or write "
                            "pictures with -o frame%04d.png",
                            path.string()));
}

struct VideoFile::Impl {
    fs::path path;
    Unnamed video = unnamedFile(), messages = unnamedFile();
    int input = -1;  // the end of the pipe that pictures go into
    pid_t child = -1;

    ~Impl() {
        closeInput();
        if (child > 0) ::kill(child, SIGKILL);
        wait();
    }
    void closeInput() {
        if (input >= 0) ::close(input);
        input = -1;
    }
    /// Whether ffmpeg ended well.
    bool wait() {
        int status = 1;
        if (child <= 0) return false;
        while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
        child = -1;
        return status == 0;
    }
    Error failed() {
        closeInput();
        wait();
        const std::string why = lastLine(bytesOf(messages.get()));
        return cannotWrite(path, why.empty() ? "ffmpeg failed without a reason" : "ffmpeg says: " + why);
    }
};

VideoFile::VideoFile(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
VideoFile::VideoFile(VideoFile&&) noexcept = default;
VideoFile& VideoFile::operator=(VideoFile&&) noexcept = default;
VideoFile::~VideoFile() = default;

Result<VideoFile> VideoFile::create(const fs::path& path, int width, int height, double framesPerSecond) {
    if (auto there = checkVideoWriter(path); !there) return there.error();
    auto impl = std::make_unique<Impl>();
    impl->path = path;
    int ends[2] = {-1, -1};
    if (!impl->video || !impl->messages || ::pipe(ends) != 0)
        return cannotWrite(path, "there is no room for a temporary file, or too many files are open");
    std::signal(SIGPIPE, SIG_IGN);  // an ffmpeg that ended early is an error of write()
    const int read = kept(ends[0]);
    impl->input = kept(ends[1]);
    const int video = ::fcntl(::fileno(impl->video.get()), F_DUPFD_CLOEXEC, 16);
    const int messages = ::fcntl(::fileno(impl->messages.get()), F_DUPFD_CLOEXEC, 16);
    const int error = start(arguments(path, width, height, framesPerSecond), read, video, messages, impl->child);
    for (const int descriptor : {read, video, messages}) ::close(descriptor);
    if (error != 0) {
        impl->child = -1;
        return cannotWrite(path, fmt::format("ffmpeg cannot be started ({})",
                                             std::error_code(error, std::generic_category()).message()));
    }
    return VideoFile(std::move(impl));
}

Result<void> VideoFile::add(std::span<const std::uint8_t> pixels) {
    while (!pixels.empty()) {
        const ssize_t written = ::write(m_impl->input, pixels.data(), pixels.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return m_impl->failed();
        pixels = pixels.subspan(std::size_t(written));
    }
    return {};
}

Result<void> VideoFile::finish() {
    m_impl->closeInput();
    if (!m_impl->wait()) return m_impl->failed();
    const std::vector<std::uint8_t> bytes = bytesOf(m_impl->video.get());
    if (bytes.empty()) return cannotWrite(m_impl->path, "ffmpeg made an empty file");
    return writeFile(m_impl->path, bytes);
}

}  // namespace probegi::tool
