#pragma once

#include <vector>

#include "probegi/scene.h"

namespace probegi {

/// An instance that moved, came or went.
struct MovedObject {
    int node = -1;
    float size = 0;    ///< SceneEdit::size
    float extent = 0;  ///< diagonal of the larger of its boxes, metres
    Bounds box;        ///< around where it was and where it is, metres
};

/// Of all its triangles, in its own frame. Zero-sized without any.
Bounds meshBounds(const Mesh& mesh);

/// Those that moved by at least `least` of their size, in the order of their nodes.
std::vector<MovedObject> movedObjects(const Scene& scene, const ScenePose& before, const ScenePose& after, float least);

}  // namespace probegi
