#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "probegi/result.h"

namespace probegi::io {

/// What a file must begin with, looked at before memory for all of it is taken.
struct FileBegin {
    std::size_t bytes = 0;  ///< that `check` sees; fewer where the file has fewer
    /// Throws Refused where these cannot begin a file of `fileBytes`.
    void (*check)(std::span<const std::uint8_t> begin, std::uint64_t fileBytes) = nullptr;
};

/// The contents of a file. Throws Refused (without the path: guarded() adds it): fileNotFound, fileUnreadable,
/// outOfMemory for more than `limit` bytes.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path, std::uint64_t limit = 0xffffffffu,
                                   const FileBegin& begin = {});

}  // namespace probegi::io
