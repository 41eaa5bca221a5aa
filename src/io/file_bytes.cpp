#include "io/file_bytes.h"

#include <algorithm>
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

/// Fills `bytes` from where the file stands.
void readOn(std::FILE* file, std::span<std::uint8_t> bytes) {
    if (std::fread(bytes.data(), 1, bytes.size(), file) == bytes.size()) return;
    const bool failed = std::ferror(file) != 0;
    refuse(ErrorCode::fileUnreadable, "cannot be read to its end ({})",
           failed ? reason(errno) : std::string("it was truncated while being read"));
}

}  // namespace

std::vector<std::uint8_t> readFile(const fs::path& path, std::uint64_t limit, const FileBegin& begin) {
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
    std::vector<std::uint8_t> bytes(std::size_t(std::min<std::uint64_t>(size, begin.bytes)));
    const std::size_t looked = bytes.size();
    readOn(file.get(), bytes);
    if (begin.check) begin.check(bytes, size);
    bytes.resize(std::size_t(size));
    readOn(file.get(), std::span(bytes).subspan(looked));
    return bytes;
}

}  // namespace probegi::io
