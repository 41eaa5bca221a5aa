#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "probegi/result.h"

namespace probegi::io {

/// What the public writeFile() does. Throws Refused (without the path: guarded() adds it): writeFailed with the reason.
void writeBytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// What the public checkWritable() does. Throws Refused as writeBytes() would.
void requireWritable(const std::filesystem::path& path);

}  // namespace probegi::io
