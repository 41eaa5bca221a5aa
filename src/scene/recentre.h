#pragma once

#include "probegi/scene.h"

namespace probegi {

/// Moves a scene that is far from the origin relative to its size: float coordinates have seven digits, and far away
/// few are left for the scene itself. Roots, their animations and the probe grid move; Scene::origin holds the shift.
/// Multiples of a power of two are subtracted, so coordinates stay exact. Returns whether it moved.
bool recentre(Scene& scene);

}  // namespace probegi
