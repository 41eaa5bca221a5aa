#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/budget.h"

namespace probegi::io {

/// Refuses what tinygltf does not survive (text nested too deeply, image views beyond their buffer, buffers that
/// multiply the file's bytes) or overlooks (checkStrictly), and rewrites what it does not understand: the indices of a
/// Draco-compressed primitive, which have no buffer view of their own. Returns the bytes to parse: `bytes` itself or,
/// in `storage`, a new file.
std::span<const std::uint8_t> prepareGltf(std::span<const std::uint8_t> bytes, Budget& budget,
                                          std::vector<std::uint8_t>& storage);

/// Binary glTF begins with this word.
bool isBinaryGltf(std::span<const std::uint8_t> bytes);

}  // namespace probegi::io
