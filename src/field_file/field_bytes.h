#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "probegi/field_file.h"

namespace probegi {

/// The bytes of saveField()'s file. Throws io::Refused, std::bad_alloc.
std::vector<std::uint8_t> encodeField(const SavedField& saved);

/// loadField() from memory; errors begin with `name`.
Result<SavedField> loadFieldFromMemory(std::string_view name, std::span<const std::uint8_t> file,
                                       const ReadLimits& limits = {});

}  // namespace probegi
