#include "output.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace probegi::tool {

namespace fs = std::filesystem;

std::vector<std::string_view> pictureExtensions() {
    return {".png", ".exr"};
}

Result<void> checkOutput(const fs::path& path, const std::vector<std::string_view>& extensions) {
    const std::string extension = path.extension().string();
    if (!extensions.empty() && std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
        return fail(ErrorCode::unsupported,
                    fmt::format("'{}' must end in {}", path.string(), fmt::join(extensions, " or ")));
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        return fail(ErrorCode::writeFailed, fmt::format("'{}' is a folder; give the name of a file", path.string()));
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored))
        return fail(ErrorCode::writeFailed,
                    fmt::format("the folder '{}' does not exist; create it first", folder.string()));
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        return fail(ErrorCode::writeFailed,
                    fmt::format("the folder '{}' cannot be written to; choose another one", folder.string()));
    return {};
}

Result<void> writeText(const fs::path& path, std::string_view text) {
    fs::path temporary = path;
    temporary += fmt::format(".{}.tmp", getpid());
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    std::error_code code;
    if (file) fs::rename(temporary, path, code);
    if (file && !code) return {};
    fs::remove(temporary, code);
    return fail(ErrorCode::writeFailed,
                fmt::format("'{}' could not be written; check the folder and the free space", path.string()));
}

std::size_t peakMemoryBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace probegi::tool
