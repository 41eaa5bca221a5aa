#pragma once

#include <glm/vec4.hpp>

#include "probegi/scene.h"

namespace probegi {

/// The channel's value at a time in seconds, clamped to its first and last key. Rotations are unit quaternions (xyzw).
/// The channel must be valid. Formulas: glTF 2.0 specification, appendix C.
glm::vec4 sampleChannel(const AnimationChannel& channel, float seconds);

/// Marks the children of marked nodes, by node.
void moveChildren(const Scene& scene, std::vector<bool>& moves);
/// By node, whether an animation moves it or one of its parents.
std::vector<bool> animatedNodes(const Scene& scene);

}  // namespace probegi
