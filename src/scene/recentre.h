#pragma once

#include "probegi/scene.h"

namespace probegi {

/// Moves a scene that lies far from the origin, for its size, to it: float coordinates have seven digits, and far away
/// few of them are left for the scene itself. Roots, their animations and the probe grid move; Scene::origin says how
/// far. Multiples of a power of two are subtracted, so no coordinate loses a digit. Returns whether it moved.
bool recentre(Scene& scene);

}  // namespace probegi
