#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "io/budget.h"

namespace probegi::io {

/// The JSON of a glTF file. What its values will take as objects is charged while they are only being counted, so that
/// a small file full of them fills no memory. Refuses what is no JSON object, and what is nested more deeply than
/// tinygltf, which recurses, survives.
nlohmann::json parseGltfText(std::span<const std::uint8_t> text, Budget& budget);

}  // namespace probegi::io
