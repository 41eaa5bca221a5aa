#pragma once

#include <cstdint>
#include <string>

#include "probegi/field_file.h"
#include "probegi/masks.h"

namespace probegi::tool {

/// "14.2 MB".
std::string sizeText(std::uint64_t bytes);
/// The lines about masks of a bake's report and of `probegi info`.
std::string masksText(const MaskReport& report);

/// `probegi info` of a field's file. Errors: those of loadField.
Result<void> printFieldInfo(const std::string& path, bool json, const ReadLimits& limits);

/// `probegi compare` of two of them. Errors: those of loadField and compareFields.
Result<void> compareFieldFiles(const std::string& a, const std::string& b, bool json, const ReadLimits& limits);

}  // namespace probegi::tool
