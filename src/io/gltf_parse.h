#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/tinygltf.h"

namespace probegi::io {

/// tinygltf's model of the file, with every external file read and every image still encoded. Refuses versions other
/// than 2 and required extensions that ProbeGI lacks; adds a warning for each optional one. Indices in the model are
/// not checked yet.
tinygltf::Model parseGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                          std::vector<std::string>& warnings);

}  // namespace probegi::io
