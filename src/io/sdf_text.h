#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "probegi/sdf.h"

namespace probegi::io {

/// loadSdf() from memory; errors begin with `name`.
Result<SdfScene> loadSdfFromMemory(std::string_view name, std::span<const std::uint8_t> text,
                                   const ReadLimits& limits = {});

/// The text of a file of valid primitives.
std::string sdfText(const SdfScene& sdf);

}  // namespace probegi::io
