#include "io/file_output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "io/refused.h"
#include "probegi/io.h"

namespace probegi {

namespace io {

namespace fs = std::filesystem;

namespace {

std::string reason(int error) {
    return std::error_code(error, std::generic_category()).message();
}

[[noreturn]] void refuseWrite(int error) {
    refuse(ErrorCode::writeFailed, "cannot be written ({}); check its permissions and the free space", reason(error));
}

/// Owns a descriptor. close() reports errors, since a full disk may show only then.
class Descriptor {
public:
    explicit Descriptor(int number) : m_number(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return m_number; }
    bool open() const { return m_number >= 0; }
    /// errno, 0 for success.
    int close() {
        const int number = m_number;
        m_number = -1;
        return number >= 0 && ::close(number) != 0 ? errno : 0;
    }

private:
    int m_number;
};

/// errno, 0 for success.
int writeAll(int descriptor, std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kMost = 1 << 30;  // some systems refuse 2 GB at once
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), std::min(bytes.size(), kMost));
        if (written < 0 && errno != EINTR) return errno;
        if (written > 0) bytes = bytes.subspan(std::size_t(written));
    }
    return 0;
}

fs::path folderOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Where the bytes written to a path go.
struct Destination {
    enum class Kind { file, device, descriptor } kind = Kind::file;
    fs::path path = {};   ///< symbolic links resolved; for a device as given
    int descriptor = -1;  ///< of this process: /dev/stdout, /dev/fd/3
};

/// The descriptor of this process that a name in /proc/self/fd refers to.
std::optional<int> descriptorOf(const fs::path& path) {
    std::error_code error;
    const fs::path descriptors = fs::canonical("/proc/self/fd", error);
    if (error || fs::canonical(folderOf(path), error) != descriptors || error) return {};
    const std::string name = path.filename().string();
    int number = -1;
    const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (code != std::errc() || end != name.data() + name.size() || ::fcntl(number, F_GETFD) < 0) return {};
    return number;
}

Destination destinationOf(const fs::path& given) {
    constexpr int kMostLinks = 40;  // what Linux follows
    std::error_code error;
    fs::path path = given;
    for (int links = 0; links < kMostLinks; ++links) {
        if (const auto descriptor = descriptorOf(path)) {
            return {Destination::Kind::descriptor, given, *descriptor};
        }
        const fs::path next = fs::read_symlink(path, error);
        if (error) break;  // no link, or nothing there
        path = next.is_absolute() ? next : folderOf(path) / next;
    }
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) refuse(ErrorCode::writeFailed, "is a folder; give the name of a file");
    if (!fs::exists(status) && status.type() != fs::file_type::not_found) refuseWrite(error.value());
    const bool device = fs::exists(status) && !fs::is_regular_file(status);
    return {device ? Destination::Kind::device : Destination::Kind::file, device ? given : path};
}

void requireFolder(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        refuse(ErrorCode::writeFailed, "cannot be written, the folder '{}' does not exist; create it first",
               folder.string());
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        refuse(ErrorCode::writeFailed, "cannot be written, the folder '{}' cannot be written to ({}); choose another",
               folder.string(), reason(errno));
    }
}

/// A name unique among all running processes and threads.
fs::path temporaryName(const fs::path& path) {
    const std::size_t thread = std::hash<std::thread::id>{}(std::this_thread::get_id());
    fs::path name = path;
    name += fmt::format(".{}-{:x}.part", ::getpid(), thread);
    return name;
}

/// An unnamed file, or none if the system has no such thing: however the process ends, nothing is left behind.
int openNameless(const fs::path& folder) {
#ifdef O_TMPFILE
    if (::access("/proc/self/fd", X_OK) == 0) {  // through which it gets its name in the end
        return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    }
#endif
    (void)folder;
    return -1;
}

/// A new file to become `path`: unnamed if possible, else with this name. On failure negative, with errno.
struct NewFile {
    int descriptor;
    bool nameless;
};

NewFile openNew(const fs::path& path, const fs::path& name) {
    ::unlink(name.c_str());  // left by a process that had this one's number and was killed
    if (const int nameless = openNameless(folderOf(path)); nameless >= 0) return {nameless, true};
    return {::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666), false};
}

/// Permissions are not enough: some file systems refuse new files regardless.
void tryNew(const fs::path& path) {
    const fs::path name = temporaryName(path);
    const NewFile made = openNew(path, name);
    if (made.descriptor < 0) refuseWrite(errno);
    ::close(made.descriptor);
    if (!made.nameless) ::unlink(name.c_str());
}

/// errno, 0 for success.
int giveName(int descriptor, const fs::path& name) {
    const std::string self = fmt::format("/proc/self/fd/{}", descriptor);
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
}

/// The new file gets the old one's permissions.
void keepPermissions(const fs::path& old, int descriptor) {
    struct stat status {};
    if (::stat(old.c_str(), &status) == 0) (void)::fchmod(descriptor, status.st_mode & 07777);
}

/// errno, 0 for success.
int replaceFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    const fs::path name = temporaryName(path);
    const NewFile made = openNew(path, name);
    Descriptor file(made.descriptor);
    if (!file.open()) return errno;
    keepPermissions(path, file.number());
    int failure = writeAll(file.number(), bytes);
    if (!failure && made.nameless) failure = giveName(file.number(), name);
    if (const int closing = file.close(); !failure) failure = closing;
    if (!failure && ::rename(name.c_str(), path.c_str()) != 0) failure = errno;
    if (failure) ::unlink(name.c_str());
    return failure;
}

/// errno, 0 for success. Opening a pipe blocks until there is a reader.
int writeDevice(const fs::path& path, std::span<const std::uint8_t> bytes) {
    Descriptor device(::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    if (!device.open()) return errno;
    const int failure = writeAll(device.number(), bytes);
    const int closing = device.close();
    return failure ? failure : closing;
}

}  // namespace

void requireWritable(const fs::path& path) {
    const Destination to = destinationOf(path);
    if (to.kind == Destination::Kind::descriptor) {
        if ((::fcntl(to.descriptor, F_GETFL) & O_ACCMODE) == O_RDONLY) refuseWrite(EBADF);
        return;
    }
    if (to.kind == Destination::Kind::file) requireFolder(folderOf(to.path));
    if (::access(to.path.c_str(), W_OK) != 0 && errno != ENOENT) refuseWrite(errno);
    if (to.kind == Destination::Kind::file) tryNew(to.path);
}

void writeBytes(const fs::path& path, std::span<const std::uint8_t> bytes) {
    requireWritable(path);
    const Destination to = destinationOf(path);
    int failure = 0;
    switch (to.kind) {
        case Destination::Kind::file:
            failure = replaceFile(to.path, bytes);
            break;
        case Destination::Kind::device:
            failure = writeDevice(to.path, bytes);
            break;
        case Destination::Kind::descriptor:
            std::fflush(nullptr);  // what was printed before comes before
            failure = writeAll(to.descriptor, bytes);
            break;
    }
    if (failure) refuseWrite(failure);
}

}  // namespace io

Result<void> writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
    return io::guarded(path.string(), [&] { io::writeBytes(path, bytes); });
}

Result<void> checkWritable(const std::filesystem::path& path) {
    return io::guarded(path.string(), [&] { io::requireWritable(path); });
}

}  // namespace probegi
