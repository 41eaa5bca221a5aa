#pragma once

#include <nlohmann/json.hpp>

namespace probegi::io {

/// Refuses what tinygltf overlooks or takes for something else: a version that the file asks for and ProbeGI lacks,
/// numbers that may not be negative or must be whole, and data: URIs that it would look for among the files. Data of a
/// media type that it does not know get one that it knows; returns whether there were any.
bool checkStrictly(nlohmann::json& root);

}  // namespace probegi::io
