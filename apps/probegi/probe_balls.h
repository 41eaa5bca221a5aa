#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "probegi/image.h"
#include "probegi/scene.h"

namespace probegi::tool {

/// Radius of the ball that stands for a probe, in its smallest spacing.
inline constexpr float kBallRadius = 0.09f;

/// A ball in the world.
struct Ball {
    glm::vec3 centre{0.0f};
    float radius = 0;         ///< metres; far away never less than a few pixels
    glm::vec3 display{0.0f};  ///< 0..1
    bool showsThroughWalls = false;
};

/// Draws the balls into display values. `depth`: distance of what the picture shows, metres, in the first channel; 0
/// where there is sky.
void drawBalls(HdrImage& shown, HdrImage depth, const PlacedCamera& camera, std::span<const Ball> balls);

}  // namespace probegi::tool
