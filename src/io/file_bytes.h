#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "probegi/result.h"

namespace probegi::io {

/// The contents of a file. Throws Refused (without the path: guarded() adds it): fileNotFound, fileUnreadable,
/// outOfMemory for more than `limit` bytes.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path, std::uint64_t limit = 0xffffffffu);

}  // namespace probegi::io
