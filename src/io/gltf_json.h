#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/budget.h"

namespace probegi::io {

/// Refuses what crashes tinygltf (text nested too deeply, image views beyond their buffer, buffers that multiply the
/// file's bytes) or escapes its checks (checkStrictly), and rewrites what it does not understand: the indices of a
/// Draco-compressed primitive, which have no buffer view of their own. Returns the bytes to parse: `bytes` itself or a
/// new file in `storage`.
std::span<const std::uint8_t> prepareGltf(std::span<const std::uint8_t> bytes, Budget& budget,
                                          std::vector<std::uint8_t>& storage);

/// By its magic number.
bool isBinaryGltf(std::span<const std::uint8_t> bytes);

}  // namespace probegi::io
