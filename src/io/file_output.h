#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "probegi/result.h"

namespace probegi::io {

/// Implements the public writeFile(). Throws Refused (without the path: guarded() adds it): writeFailed with the
/// reason.
void writeBytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// Implements the public checkWritable(). Throws Refused as writeBytes() would.
void requireWritable(const std::filesystem::path& path);

}  // namespace probegi::io
