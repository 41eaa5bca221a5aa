#pragma once

#include "gltf_builder.h"

namespace probegi::test {

/// A grid of size x size quads with a bump, compressed by Draco: POSITION, NORMAL and TEXCOORD_0 in
/// KHR_draco_mesh_compression, with accessors without buffer views, as exporters write them.
GltfBuilder dracoScene(int size = 4);

}  // namespace probegi::test
