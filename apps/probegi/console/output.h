#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "probegi/image.h"

namespace probegi::tool {

/// The files that a command will write, each claimed before the work for its contents begins. No two outputs may be the
/// same file, nor may one be an input. Devices and pipes may be given several times.
class Outputs {
public:
    /// Checks that a file can be written there and that its extension is one of `extensions` (empty: any). `option`:
    /// the command-line option, for errors. Errors: unsupported, writeFailed, invalidArgument.
    Result<void> claim(std::string option, const std::filesystem::path& path,
                       const std::vector<std::string_view>& extensions = {});

    /// Errors: invalidArgument if an output is one of the files that are read.
    Result<void> keepApartFrom(const std::vector<std::filesystem::path>& inputs) const;

private:
    struct Claimed {
        std::string option;
        std::filesystem::path path;
    };
    std::vector<Claimed> m_claimed;
};

/// writeFile() for text. Errors: writeFailed.
Result<void> writeText(const std::filesystem::path& path, std::string_view text);

/// JSON as every command prints or writes it, with a newline at the end. File names may contain any bytes; invalid
/// UTF-8 becomes U+FFFD.
std::string jsonText(const nlohmann::ordered_json& json);

/// Extensions of the picture formats that can be written.
std::vector<std::string_view> pictureExtensions();

/// Peak memory of this process so far.
std::size_t peakMemoryBytes();

}  // namespace probegi::tool
