#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "io/budget.h"

namespace probegi::io {

/// Parses the JSON of a file of a kind that messages name. The memory for its values is charged in a counting pass
/// first, so that a small file with very many values cannot exhaust memory. Refuses anything but a JSON object, and
/// nesting too deep for tinygltf's recursion.
nlohmann::json parseJsonText(std::span<const std::uint8_t> text, Budget& budget, std::string_view kind = "glTF");

}  // namespace probegi::io
