#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "probegi/image.h"

namespace probegi::tool {

/// Whether a file can be written there, asked before the work that makes its content: its folder exists and is
/// writable, and its ending is one of `extensions` (empty: any). Errors: unsupported, writeFailed.
Result<void> checkOutput(const std::filesystem::path& path, const std::vector<std::string_view>& extensions);

/// Writes a text file whole or not at all. Errors: writeFailed.
Result<void> writeText(const std::filesystem::path& path, std::string_view text);

/// Endings of pictures that can be written.
std::vector<std::string_view> pictureExtensions();

/// Largest memory that this process has held so far.
std::size_t peakMemoryBytes();

}  // namespace probegi::tool
