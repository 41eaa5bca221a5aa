#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "probegi/io.h"

namespace probegi::io {

/// Reads glTF 2.0, text or binary, from memory; errors begin with `name`. Files that it refers to must be in
/// `folder` or below; an empty folder refuses them all. The scene has passed validate().
Result<LoadedScene> loadGltfFromMemory(std::string_view name, std::span<const std::uint8_t> bytes,
                                       const std::filesystem::path& folder, const ReadLimits& limits = {});

/// The same for loadScene(), which validates later, after its additions. Throws Refused.
LoadedScene importGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                       const ReadLimits& limits);

}  // namespace probegi::io
