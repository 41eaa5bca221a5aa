#include "io/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <memory>

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
        const bool failed = std::ferror(file.get()) != 0;
        refuse(ErrorCode::fileUnreadable, "cannot be read to its end ({})",
               failed ? reason(errno) : std::string("it was truncated while being read"));
    }
    return bytes;
}

}  // namespace probegi::io
