#pragma once

#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// A thing that sends or blocks light: a point, or a box whose faces do.
struct EditSource {
    Bounds box;        ///< metres; without size: a point
    float range = 0;   ///< metres that its light goes; 0: any distance
    glm::vec3 axis{};  ///< of a cone, unit; zero: all directions
    float cosCone = -1;
};

/// Rays of each source.
inline constexpr int kReachRays = 256;

/// What a source's light meets.
struct EditReach {
    Bounds box;              ///< around the source and all that its light reaches directly or by one bounce
    float meanDistance = 0;  ///< to what it meets directly, metres; 0 if that is nothing
};

/// In the order of the sources; the same for the same scene. Where light leaves the scene, the box ends at the scene's
/// bounds. Errors: those of the tracer.
Result<std::vector<EditReach>> findReaches(const Tracer& tracer, const std::vector<EditSource>& sources);

}  // namespace probegi
