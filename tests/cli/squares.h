#pragma once

#include <nlohmann/json.hpp>

namespace probegi::test {

/// A glTF scene whose node 0 is the root and whose mesh 0 is a square from (0, 0, 0) to (1, 0, 1) that faces up.
inline nlohmann::json sceneOfSquares(const nlohmann::json& nodes) {
    return {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", nodes},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", 5}}}}}}},
            {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}}}},
            {"bufferViews", {{{"buffer", 0}, {"byteLength", 48}}}},
            // (0,0,0) (0,0,1) (1,0,0) (1,0,1)
            {"buffers",
             {{{"byteLength", 48},
               {"uri",
                "data:application/octet-stream;base64,"
                "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAAAACAPwAAAAAAAIA/"}}}}};
}

}  // namespace probegi::test
