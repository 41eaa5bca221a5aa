#pragma once

#include "probegi/probegi.h"

namespace probegi::test {

/// A small hall with everything that a pass may meet: lights of all types, a sky with a picture, a lamp of triangles,
/// textures, a normal map, a fence with holes, a single-sided wall seen from behind, a mirrored and a shared mesh, and
/// blocks that probes stand in.
Scene richScene();

/// A camera that sees most of it.
PlacedCamera richCamera();

}  // namespace probegi::test
