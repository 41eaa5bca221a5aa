#pragma once

#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "probegi/tracer.h"

namespace probegi {

/// A point on a surface, and the side that faces the open, unit.
struct WallSample {
    glm::vec3 position, normal;
};

/// The orientation that most surfaces stand by, as one from the world's axes that turns as little as can be: most often
/// a building's. The world's own where that serves nearly as many of them, or where no two sorts of surfaces stand at
/// right angles. Deterministic.
glm::quat wallFrame(std::span<const WallSample> samples);

/// Bounds along a frame's axes of what a tracer can hit, as 6 x 48^2 rays from outside and the samples find them, in
/// the frame's coordinates (the world's, turned back): what is thinner than a 48th of the scene may reach beyond.
/// Errors: those of the tracer.
Result<Bounds> boundsInFrame(const Tracer& tracer, std::span<const WallSample> samples, const glm::quat& frame);

}  // namespace probegi
