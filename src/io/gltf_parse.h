#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "io/tinygltf.h"
#include "probegi/io.h"

namespace probegi::io {

/// tinygltf's model of the file, with every external file read and every image still encoded. Refuses versions other
/// than 2 and required extensions that ProbeGI lacks; adds a warning for each such optional one, and the files read.
/// Indices in the model are not checked yet.
tinygltf::Model parseGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                          const ReadLimits& limits, LoadedScene& out);

}  // namespace probegi::io
