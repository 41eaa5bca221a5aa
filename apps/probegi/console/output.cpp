#include "console/output.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "probegi/io.h"

namespace probegi::tool {

namespace fs = std::filesystem;

namespace {

/// Whether writing would replace the file, which is not so for devices, pipes and streams of this process.
bool replaceable(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return !fs::exists(status) || fs::is_regular_file(status);
}

bool sameFile(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error) && !error;
}

}  // namespace

std::vector<std::string_view> pictureExtensions() {
    return {".png", ".exr"};
}

Result<void> Outputs::claim(std::string option, const fs::path& path, const std::vector<std::string_view>& extensions) {
    const std::string extension = path.extension().string();
    if (!extensions.empty() && std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
        return fail(ErrorCode::unsupported,
                    fmt::format("{} '{}' must end in {}", option, path.string(), fmt::join(extensions, " or ")));
    if (auto writable = checkWritable(path); !writable)
        return fail(writable.error().code, fmt::format("{} {}", option, writable.error().message));
    if (replaceable(path))
        for (const Claimed& other : m_claimed)
            if (sameFile(other.path, path))
                return fail(ErrorCode::invalidArgument,
                            fmt::format("{} and {} are both '{}'; give each a file of its own", other.option, option,
                                        path.string()));
    m_claimed.push_back({std::move(option), path});
    return {};
}

Result<void> Outputs::keepApartFrom(const std::vector<fs::path>& inputs) const {
    for (const Claimed& output : m_claimed)
        for (const fs::path& input : inputs)
            if (replaceable(output.path) && sameFile(output.path, input))
                return fail(ErrorCode::invalidArgument,
                            fmt::format("{} '{}' would overwrite a file that is read; choose another name",
                                        output.option, output.path.string()));
    return {};
}

Result<void> writeText(const fs::path& path, std::string_view text) {
    return writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string jsonText(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::size_t peakMemoryBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

}  // namespace probegi::tool
