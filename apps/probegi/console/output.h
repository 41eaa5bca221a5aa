#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "probegi/image.h"

namespace probegi::tool {

/// The files that a command is going to write, each asked for before the work that makes its content: no two may be one
/// file, and none may be one that was read. Devices and pipes may take any number.
class Outputs {
public:
    /// Whether a file can be written there, and its ending is one of `extensions` (empty: any). `option` is what the
    /// user wrote before it. Errors: unsupported, writeFailed, invalidArgument.
    Result<void> claim(std::string option, const std::filesystem::path& path,
                       const std::vector<std::string_view>& extensions = {});

    /// Errors: invalidArgument where an output is one of the files that are read.
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

/// JSON as every command prints or writes it, with a line break at the end. Names of files may be of any bytes: what is
/// no UTF-8 becomes the sign for that.
std::string jsonText(const nlohmann::ordered_json& json);

/// Endings of pictures that can be written.
std::vector<std::string_view> pictureExtensions();

/// Largest memory that this process has held so far.
std::size_t peakMemoryBytes();

}  // namespace probegi::tool
