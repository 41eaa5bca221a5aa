#include "io/file_bytes.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <thread>

#include "io/refused.h"

namespace probegi::io {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason(int error) {
    return std::error_code(error, std::generic_category()).message();
}

/// A name that no other process and no other thread of this one uses now.
fs::path temporaryName(const fs::path& path) {
    const std::size_t thread = std::hash<std::thread::id>{}(std::this_thread::get_id());
    fs::path name = path;
    name += fmt::format(".{}-{:x}.part", ::getpid(), thread);
    return name;
}

/// Writes and closes; the result is errno, 0 for success. Closing can be what finds a full disk.
int writeAll(const fs::path& path, std::span<const std::uint8_t> bytes) {
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) return errno;
    if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) return errno ? errno : EIO;
    if (std::fclose(file.release()) != 0) return errno ? errno : EIO;
    return 0;
}

}  // namespace

std::vector<std::uint8_t> readFile(const fs::path& path, std::uint64_t limit) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) {
        if (status.type() == fs::file_type::not_found) {
            refuse(ErrorCode::fileNotFound, "there is no such file; check the path");
        }
        refuse(ErrorCode::fileUnreadable, "cannot be opened ({}); check the path and its permissions", error.message());
    }
    if (!fs::is_regular_file(status)) refuse(ErrorCode::fileUnreadable, "is not a file; give the path of a file");
    const std::uint64_t size = fs::file_size(path, error);
    if (error) refuse(ErrorCode::fileUnreadable, "cannot be read ({})", error.message());
    if (size > limit) refuse(ErrorCode::outOfMemory, "has {} bytes; at most {} are supported", size, limit);
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) refuse(ErrorCode::fileUnreadable, "cannot be opened ({}); check its permissions", reason(errno));
    std::vector<std::uint8_t> bytes(size);
    if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
        refuse(ErrorCode::fileUnreadable, "cannot be read to its end ({})", reason(errno));
    }
    return bytes;
}

void writeFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        refuse(ErrorCode::writeFailed, "is a folder or a device; give the name of a file");
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) {
        refuse(ErrorCode::writeFailed, "cannot be written, the folder {} does not exist; create it first",
               folder.string());
    }
    const fs::path temporary = temporaryName(path);
    int failure = writeAll(temporary, bytes);
    if (!failure && std::rename(temporary.c_str(), path.c_str()) != 0) failure = errno;
    if (!failure) return;
    fs::remove(temporary, error);
    refuse(ErrorCode::writeFailed, "cannot be written ({}); check the folder's permissions and the free space",
           reason(failure));
}

}  // namespace probegi::io
