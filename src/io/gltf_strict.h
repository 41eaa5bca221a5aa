#pragma once

#include <nlohmann/json.hpp>

namespace probegi::io {

/// Refuses what tinygltf misses or misreads: a minVersion that ProbeGI lacks, numbers that must not be negative or must
/// be integers, and data: URIs that it would treat as file names. Unknown media types of data are replaced by a known
/// one; returns whether there were any.
bool checkStrictly(nlohmann::json& root);

}  // namespace probegi::io
