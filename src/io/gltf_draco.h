#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/tinygltf.h"

namespace probegi::io {

/// One attribute of every vertex, as packed floats.
struct DracoAttribute {
    int components = 0;
    std::vector<float> values;
};

/// A primitive compressed by KHR_draco_mesh_compression.
struct DracoPrimitive {
    std::vector<std::uint32_t> indices;  ///< 3 per triangle, each below the number of vertices
    std::map<std::string, DracoAttribute> attributes;
};

/// Decompresses. `extension` is the primitive's KHR_draco_mesh_compression object. Throws Refused.
DracoPrimitive decodeDraco(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           const tinygltf::Value& extension);

}  // namespace probegi::io
