#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "probegi/result.h"

namespace probegi::io {

/// The whole of a file. Throws Refused (without the path: guarded() adds it): fileNotFound, fileUnreadable,
/// outOfMemory for more than `limit` bytes.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path, std::uint64_t limit = 0xffffffffu);

/// Makes the file appear with these bytes, whole or not at all: they go to a temporary name in the same folder, which
/// is then renamed. Throws Refused: writeFailed with the reason.
void writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace probegi::io
